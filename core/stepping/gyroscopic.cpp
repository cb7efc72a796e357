#include "core/stepping/gyroscopic.hpp"

namespace substep {

// Newton on F(w) = I w - dt/2 (I w) x w - p.
// dF = I - dt/2 ([I w] - [w] I), since d((I w) x w) = (I dw) x w + (I w) x dw = (-[w] I + [I w])
// dw.
Vec3 gyroscopic_implicit(const Vec3& I, const Vec3& w, double dt_before, double dt) {
  constexpr int kIterations = 8;       // quadratic: three or four are enough below a radian a step
  constexpr double kRelative = 1e-30;  // of |p|^2
  const Vec3 p = I.cwiseProduct(w) + 0.5 * dt_before * I.cwiseProduct(w).cross(w);
  Vec3 next = w;
  for (int i = 0; i < kIterations; ++i) {
    const Vec3 Iw = I.cwiseProduct(next);
    const Vec3 F = Iw - 0.5 * dt * Iw.cross(next) - p;
    if (F.squaredNorm() <= kRelative * p.squaredNorm()) break;
    Mat3 dF = -0.5 * dt * (skew(Iw) - skew(next) * I.asDiagonal());
    dF.diagonal() += I;
    next -= dF.inverse() * F;
  }
  return next;
}

Vec3 gyroscopic_explicit(const Vec3& I, const Vec3& w, double dt) {
  const Vec3 torque = I.cwiseProduct(w).cross(w);
  return w + dt * torque.cwiseQuotient(I);
}

}  // namespace substep
