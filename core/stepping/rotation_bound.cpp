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

constexpr double square(double x) { return x * x; }

/// From the rotation and the gyroscopic rate [1/s^2].
double rate_squared(const Vec3& I, const Vec3& omega_B) {
  const double turn = square(kTurnShare) * omega_B.squaredNorm();
  return differ(I) && turn > 0.0 ? std::max(turn, gyroscopic_rate_squared(I, omega_B)) : turn;
}

Vec3 angular_velocity_B(const State& state, int body) {
  return state.q[index(body)].conjugate() * Vec3(state.u[index(body)].tail<3>());
}

bool moves(const Scene& scene, int body) {
  return body != kWorld && !scene.bodies[index(body)].is_static;
}

}  // namespace

RotationCriterion::RotationCriterion(const Scene& scene) {
  std::vector<int> joints(scene.bodies.size(), 0);  // of each moving body
  if (scene.effects.joints) {
    for (const Joint& joint : scene.joints) {
      for (const int body : {base(joint).a, base(joint).b}) {
        if (moves(scene, body)) ++joints[index(body)];
      }
    }
    find_pendulums(scene, joints);
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Body& body = scene.bodies[i];
    const bool tumbles = !body.is_static && scene.effects.gyroscopic && differ(body.inertia);
    counts_.push_back(tumbles || joints[i] > 0 ? 1 : 0);
  }
}

void RotationCriterion::find_pendulums(const Scene& scene, std::span<const int> joints) {
  for (const Joint& joint : scene.joints) {
    const bool by_a = moves(scene, base(joint).a);
    if (by_a == moves(scene, base(joint).b)) continue;
    const int body = by_a ? base(joint).a : base(joint).b;
    if (joints[index(body)] != 1) continue;
    const Vec3& arm = by_a ? base(joint).anchor_a : base(joint).anchor_b;
    pendulums_.push_back({body, arm.norm() > 0.0 ? Vec3(arm.normalized()) : arm});
  }
}

RotationBound RotationCriterion::bound(const Scene& scene, std::span<const int> bodies,
                                       const State& state) const {
  RotationBound most;
  for (const int body : bodies) {
    if (counts_[index(body)] == 0) continue;
    double r = rate_squared(scene.bodies[index(body)].inertia, angular_velocity_B(state, body));
    if (!state.rotation.empty()) {
      const RatePeak& peak = state.rotation[index(body)];
      r = std::max({r, peak.before, peak.now});
    }
    if (r > most.r) most = {r, body};
  }
  return most;
}

void RotationCriterion::remember(const Scene& scene, State& state) const {
  if (pendulums_.empty()) return;
  state.rotation.resize(scene.bodies.size());
  const bool shift = state.rotation_age >= kRotationWindow;
  if (shift) state.rotation_age = 0.0;
  state.rotation_age += scene.frame;
  for (const Pendulum& pendulum : pendulums_) {
    RatePeak& peak = state.rotation[index(pendulum.body)];
    if (shift) peak = {peak.now, 0.0};
    const Vec3 omega_B = angular_velocity_B(state, pendulum.body);
    const double arm = square(kArmShare) * omega_B.cross(pendulum.arm).squaredNorm();
    const double turn = rate_squared(scene.bodies[index(pendulum.body)].inertia, omega_B);
    peak.now = std::max({peak.now, arm, turn});
  }
}

}  // namespace substep
