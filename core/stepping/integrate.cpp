#include "core/stepping/integrate.hpp"

#include <algorithm>
#include <cmath>

#include "core/stepping/gyroscopic_stage.hpp"

namespace substep {

namespace {

/// (1, half) * q, normalised. @param half dt omega/2, world axes
Quat turned(const Quat& q, const Vec3& half) {
  const Vec3 v = q.vec();
  Eigen::Vector4d product;  // x, y, z, w
  product << (v + q.w() * half) + half.cross(v), q.w() - half.dot(v);
  double length = product.norm();
  if (!std::isfinite(length)) length = product.stableNorm();  // the squares overflow first
  return std::isfinite(length) ? Quat((1.0 / length) * product) : q;
}

}  // namespace

void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state) {
  for (const int body : part.moving) {
    const std::size_t i = index(body);
    state.x[i] += dt * u[i].head<3>();
    state.q[i] = turned(state.q[i], 0.5 * dt * u[i].tail<3>());
  }
}

void turn_spin(const Substep& /*sub*/, std::size_t body, const Quat& turn, State& state) {
  state.u[body].tail<3>() = turn * Vec3(state.u[body].tail<3>());
}

void integrate(const Substep& sub, std::span<const Vec6> u, TurnSpin* turn, State& state) {
  if (sub.shift.empty()) return integrate(*sub.part, sub.dt, u, state);
  for (const int body : sub.part->moving) {
    const std::size_t i = index(body);
    const Vec6 w = u[i] + sub.shift[i];
    state.x[i] += sub.dt * w.head<3>();
    const Quat moved = turned(state.q[i], 0.5 * sub.dt * w.tail<3>());
    if (turns_otherwise(sub, i) && !sub.shift[i].tail<3>().isZero(0.0)) {
      const Quat unshifted = turned(state.q[i], 0.5 * sub.dt * u[i].tail<3>());
      turn(sub, i, moved * unshifted.conjugate(), state);
    }
    state.q[i] = moved;
  }
}

void rotation_matrices(std::span<const int> bodies, const State& state, std::span<Mat3> R_WB) {
  for (const int body : bodies) R_WB[index(body)] = state.q[index(body)].toRotationMatrix();
}

double most_kinetic(const Body& body, const Vec6& u) {
  return std::max(1.0, body.mass) * u.head<3>().squaredNorm() +
         std::max(1.0, body.inertia.maxCoeff()) * u.tail<3>().squaredNorm();
}

void keep_finite(const Body& body, const Vec6& u, Vec6& synchronised) {
  if (!std::isfinite(most_kinetic(body, synchronised))) synchronised = u;
}

}  // namespace substep
