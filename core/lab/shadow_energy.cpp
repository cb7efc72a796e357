#include "core/lab/shadow_energy.hpp"

#include <algorithm>

#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

/// M of a body on a velocity, world axes.
Vec6 momentum_of(const Body& body, const Quat& q, const Vec6& u) {
  Vec6 p;
  p.head<3>() = body.mass * u.head<3>();
  p.tail<3>() = q * body.inertia.cwiseProduct(q.conjugate() * Vec3(u.tail<3>()));
  return p;
}

}  // namespace

ShadowEnergy::ShadowEnergy(const Scene& scene, const State& state, const FrameReport& start)
    : u_(state.u), q_(state.q), report_(start) {
  constexpr double kNoise = 1e-6;  // of the weight times the size
  const double gravity = scene.effects.gravity ? scene.gravity.norm() : 0.0;
  for (const Body& body : scene.bodies) {
    if (!body.is_static) noise_ += kNoise * body.mass * gravity * radius_around(body.shape);
  }
}

bool ShadowEnergy::applies(const Scene& scene) {
  const Effects& effects = scene.effects;
  if (effects.contact || effects.limits || effects.armature) return false;
  if (effects.drives || effects.springs) return false;
  return std::all_of(scene.joints.begin(), scene.joints.end(), [](const Joint& joint) {
    return base(joint).compliance == 0.0 && angular_compliance_of(joint).value_or(0.0) == 0.0;
  });
}

FrameReport ShadowEnergy::add(const Scene& scene, const State& state, const FrameReport& report) {
  double kinetic = 0.0;
  double excess = 0.0;
  for (std::size_t i = 0; i < u_.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    const Vec6 change = state.u[i] - u_[i];
    kinetic += 0.5 * u_[i].dot(momentum_of(body, q_[i], state.u[i]));
    excess += 0.125 * change.dot(momentum_of(body, q_[i], change));
  }
  FrameReport before = report_;
  before.energy += kinetic - before.kinetic;
  before.kinetic = kinetic;
  kinetic_ = std::max(kinetic_, kinetic);
  excess_ = std::max(excess_, excess);
  u_ = state.u;
  q_ = state.q;
  report_ = report;
  return before;
}

// Plus a tenth of the kinetic energy: accelerations are not all oscillation.
bool ShadowEnergy::exceeds_stable(double share) const {
  constexpr double kBesides = 0.1;
  const double q = share * share;
  return excess_ > (q / (1.0 - q) + kBesides) * kinetic_ + noise_;
}

}  // namespace substep
