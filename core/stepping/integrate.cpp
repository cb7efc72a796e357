#include "core/stepping/integrate.hpp"

namespace substep {

void integrate(const Part& part, double dt, State& state) {
  for (const int index : part.moving) {
    const auto i = static_cast<std::size_t>(index);
    state.x[i] += dt * state.u[i].head<3>();
    const Vec3 half = 0.5 * dt * state.u[i].tail<3>();
    const Quat& q = state.q[i];
    // (1, half) * q, world axes.
    const Vec3 v = q.vec();
    const Vec3 turned = v + q.w() * half + half.cross(v);
    state.q[i] = Quat(q.w() - half.dot(v), turned.x(), turned.y(), turned.z()).normalized();
  }
}

}  // namespace substep
