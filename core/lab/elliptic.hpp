#pragma once
// Jacobi's elliptic functions by the arithmetic-geometric mean: the motions of pendulums and of
// free bodies in closed form.

namespace substep {

/// Complete elliptic integral of the first kind, K(m) = pi / (2 agm(1, sqrt(1 - m))).
/// @param m parameter k^2, in [0, 1) [-]
double complete_elliptic(double m);

/// Jacobi's functions of one argument [-].
struct Jacobi {
  double am = 0.0;  // amplitude [rad], continuous in u
  double sn = 0.0;  // sin am
  double cn = 0.0;  // cos am
  double dn = 0.0;  // sqrt(1 - m sn^2)
};

/// sn, cn, dn and am by descending Landen transformations; accurate to some rounding errors of u.
/// @param u argument [-]  @param m parameter k^2, in [0, 1) [-]
Jacobi jacobi(double u, double m);

}  // namespace substep
