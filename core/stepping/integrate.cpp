#include "core/stepping/integrate.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/lanes.hpp"

namespace substep {

namespace {

void integrate(auto bodies, double dt, std::span<const Vec6> velocities, State& state) {
  using T = typename decltype(bodies)::T;
  const auto u = bodies.at([&](int i) { return velocities[index(i)].data(); });
  const auto x = bodies.at([&](int i) { return state.x[index(i)].data(); });
  for (int k = 0; k < 3; ++k) x.set(k, x[k] + dt * u[k]);

  // (1, half) * q, world axes; q is stored as x, y, z, w.
  const double half_dt = 0.5 * dt;
  const Lanes3<T> half{half_dt * u[3], half_dt * u[4], half_dt * u[5]};
  const auto q = bodies.at([&](int i) { return state.q[index(i)].coeffs().data(); });
  const Lanes3<T> v = vector_at(q);
  const T w = q[3];
  const Lanes3<T> turned = (v + w * half) + cross(half, v);
  const T cosine = w - dot(half, v);
  const T norm =
      root((turned.x * turned.x + turned.y * turned.y) + (turned.z * turned.z + cosine * cosine));
  const T per_norm = 1.0 / norm;
  set_vector(q, 0, per_norm * turned);
  q.set(3, per_norm * cosine);
}

}  // namespace

void integrate(const Part& part, double dt, std::span<const Vec6> u, State& state) {
  in_pairs(part.moving, [&](auto bodies) { integrate(bodies, dt, u, state); });
}

void rotation_matrices(std::span<const int> bodies, const State& state, std::span<Mat3> R_WB) {
  in_pairs(bodies, [&](auto some) {
    rotation_matrix(some.at([&](int i) { return state.q[index(i)].coeffs().data(); }),
                    some.at([&](int i) { return R_WB[index(i)].data(); }));
  });
}

double most_kinetic(const Body& body, const Vec6& u) {
  return std::max(1.0, body.mass) * u.head<3>().squaredNorm() +
         std::max(1.0, body.inertia.maxCoeff()) * u.tail<3>().squaredNorm();
}

void keep_finite(const Body& body, const Vec6& u, Vec6& synchronised) {
  if (!std::isfinite(most_kinetic(body, synchronised))) synchronised = u;
}

}  // namespace substep
