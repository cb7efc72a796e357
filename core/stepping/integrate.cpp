#include "core/stepping/integrate.hpp"

namespace substep {

void integrate(const Part& part, double dt, State& state) {
  for (const int index : part.moving) {
    const auto i = static_cast<std::size_t>(index);
    state.x[i] += dt * state.u[i].head<3>();
    const Vec3 half = 0.5 * dt * state.u[i].tail<3>();
    Quat& q = state.q[i];
    // (1, half) * q, world axes.
    const Vec3 v = q.vec();
    const double w = q.w();
    q.vec() = v + w * half + half.cross(v);
    q.w() = w - half.dot(v);
    q.coeffs() *= 1.0 / q.norm();
  }
}

}  // namespace substep
