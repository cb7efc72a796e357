#include "core/stepping/integrate.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state,
               std::span<const Vec6> shift) {
  const double half_dt = 0.5 * dt;
  for (const int body : part.moving) {
    const std::size_t i = index(body);
    const Vec6 w = shift.empty() ? u[i] : Vec6(u[i] + shift[i]);
    state.x[i] += dt * w.head<3>();
    // (1, half) * q, world axes
    Quat& q = state.q[i];
    const Vec3 half = half_dt * w.tail<3>();
    const Vec3 v = q.vec();
    Eigen::Vector4d turned;  // x, y, z, w
    turned << (v + q.w() * half) + half.cross(v), q.w() - half.dot(v);
    double length = turned.norm();
    if (!std::isfinite(length)) length = turned.stableNorm();  // the squares overflow first
    if (std::isfinite(length)) q.coeffs() = (1.0 / length) * turned;
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
