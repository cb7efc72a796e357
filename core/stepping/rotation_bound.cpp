#include "core/stepping/rotation_bound.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

namespace {

/// @param I principal moments [kg m^2]  @param omega_B about the principal axes [rad/s]
double gyroscopic_rate_squared(const Vec3& I, const Vec3& omega_B) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double I_j = I[(i + 1) % 3];
    const double I_k = I[(i + 2) % 3];
    sum += omega_B[i] * omega_B[i] * std::abs((I[i] - I_j) * (I[i] - I_k)) / (I_j * I_k);
  }
  return sum;
}

bool differ(const Vec3& I) { return !(I[0] == I[1] && I[1] == I[2]); }

}  // namespace

RotationCriterion::RotationCriterion(const Scene& scene) : counts_(scene.bodies.size(), 0) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const Body& body = scene.bodies[i];
    counts_[i] = !body.is_static && scene.effects.gyroscopic && differ(body.inertia) ? 1 : 0;
  }
  if (!scene.effects.joints) return;
  for (const Joint& joint : scene.joints) {
    for (const int body : {base(joint).a, base(joint).b}) {
      if (body != kWorld && !scene.bodies[index(body)].is_static) counts_[index(body)] = 1;
    }
  }
}

RotationBound RotationCriterion::bound(const Scene& scene, std::span<const int> bodies,
                                       std::span<const Vec6> u, std::span<const Quat> q_WB) const {
  RotationBound most;
  for (const int body : bodies) {
    const std::size_t i = index(body);
    if (counts_[i] == 0) continue;
    const Vec3 omega = u[i].tail<3>();
    const Vec3& I = scene.bodies[i].inertia;
    double r = kTurnShare * kTurnShare * omega.squaredNorm();
    if (differ(I) && r > 0.0) {
      r = std::max(r, gyroscopic_rate_squared(I, q_WB[i].conjugate() * omega));
    }
    if (r > most.r) most = {r, body};
  }
  return most;
}

}  // namespace substep
