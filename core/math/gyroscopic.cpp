#include "core/math/gyroscopic.hpp"

#include <Eigen/LU>

namespace substep {

// Newton on F(w) = I w - dt/2 (I w) x w - p.
// dF = I - dt/2 ([I w] - [w] I), since d((I w) x w) = (I dw) x w + (I w) x dw = (-[w] I + [I w])
// dw.
Vec3 velocity_of_momentum(const Vec3& I, const Vec3& p, double dt, const Vec3& guess) {
  constexpr int kIterations = 8;       // quadratic: three or four are enough below a radian a step
  constexpr double kRelative = 1e-30;  // of |p|^2
  Vec3 w = guess;
  for (int i = 0; i < kIterations; ++i) {
    const Vec3 Iw = I.cwiseProduct(w);
    const Vec3 F = Iw - 0.5 * dt * Iw.cross(w) - p;
    if (F.squaredNorm() <= kRelative * p.squaredNorm()) break;
    Mat3 dF = -0.5 * dt * (skew(Iw) - skew(w) * I.asDiagonal());
    dF.diagonal() += I;
    w -= dF.inverse() * F;
  }
  return w;
}

Vec3 gyroscopic_explicit(const Vec3& I, const Vec3& w, double dt) {
  return w + dt * gyroscopic_torque(I, w).cwiseQuotient(I);
}

}  // namespace substep
