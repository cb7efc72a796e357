#include "core/lab/elliptic.hpp"

#include <cmath>
#include <numbers>

namespace substep {

double complete_elliptic(double m) {
  double a = 1.0;
  double b = std::sqrt(1.0 - m);
  // The mean converges quadratically: eight steps suffice for every m below 1 - 1e-15.
  for (int i = 0; i < 8; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / (2.0 * a);
}

// With a_0 = 1, b_0 = sqrt(1 - m), c_0 = sqrt(m) and
//   a_{n+1} = (a_n + b_n)/2,  b_{n+1} = sqrt(a_n b_n),  c_{n+1} = (a_n - b_n)/2,
// the amplitude follows backwards from phi_N = 2^N a_N u by
//   sin(2 phi_{n-1} - phi_n) = (c_n/a_n) sin phi_n,   am(u) = phi_0
// (Abramowitz and Stegun, 16.4).
Jacobi jacobi(double u, double m) {
  constexpr int kSteps = 8;
  double a[kSteps + 1];
  double c[kSteps + 1];
  a[0] = 1.0;
  c[0] = std::sqrt(m);
  double b = std::sqrt(1.0 - m);
  for (int n = 0; n < kSteps; ++n) {
    a[n + 1] = 0.5 * (a[n] + b);
    c[n + 1] = 0.5 * (a[n] - b);
    b = std::sqrt(a[n] * b);
  }
  double phi = std::ldexp(a[kSteps] * u, kSteps);
  for (int n = kSteps; n > 0; --n) phi = 0.5 * (phi + std::asin(c[n] / a[n] * std::sin(phi)));
  const double sine = std::sin(phi);
  return {phi, sine, std::cos(phi), std::sqrt(1.0 - m * sine * sine)};
}

}  // namespace substep
