#include "core/stepping/effective_mass.hpp"

#include <algorithm>

namespace substep {

namespace {

/// R diag(d) R^T, exactly symmetric.
Mat3 turned(const Mat3& R, const Vec3& d) {
  Mat3 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      m(i, j) = R(i, 0) * d[0] * R(j, 0) + R(i, 1) * d[1] * R(j, 1) + R(i, 2) * d[2] * R(j, 2);
      m(j, i) = m(i, j);
    }
  }
  return m;
}

}  // namespace

void inverse_mass(const Scene& scene, std::span<const Mat3> R_WB, std::vector<InverseMass>& out) {
  out.resize(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) {
      out[i] = InverseMass{};
      continue;
    }
    out[i].linear = 1.0 / body.mass;
    const Vec3& I = body.inertia;
    if (I[0] == I[1] && I[1] == I[2]) {
      out[i].angular = Mat3::Identity() / I[0];
    } else {
      out[i].angular = turned(R_WB[i], I.cwiseInverse());
    }
  }
}

void damped_inverse_mass(const Scene& scene, std::span<const Mat3> R_WB, std::span<const Vec6> k,
                         double alpha, double dt, std::vector<InverseMass>& out,
                         std::span<Vec6> u) {
  inverse_mass(scene, R_WB, out);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static || i >= k.size()) continue;
    Vec3 damped = body.inertia;  // I + dt b
    bool any = false;
    for (int j = 0; j < 3; ++j) {
      const double dt_b = dt * dt * k[i][3 + j] - 4.0 * alpha * body.inertia[j];
      if (dt_b <= 0.0) continue;
      damped[j] += dt_b;
      any = true;
    }
    if (!any) continue;
    const Mat3& R = R_WB[i];
    out[i].angular = turned(R, damped.cwiseInverse());
    const Vec3 omega_B = R.transpose() * u[i].tail<3>();
    u[i].tail<3>() = R * omega_B.cwiseProduct(body.inertia).cwiseQuotient(damped);
  }
}

}  // namespace substep
