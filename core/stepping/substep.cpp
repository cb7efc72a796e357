#include "core/stepping/substep.hpp"

#include "core/forces/applied_forces.hpp"

#include <algorithm>

#include "core/model/joint_fields.hpp"

namespace substep {

namespace {

std::vector<MotorsOnBody> motors_on_bodies(const Scene& scene) {
  std::vector<MotorsOnBody> on;
  const Effects& effects = scene.effects;
  if (!effects.joints || !(effects.motors || effects.drives || effects.springs)) return on;
  on.resize(scene.bodies.size());
  for (const Joint& joint : scene.joints) {
    const Motor* motor = effects.motors ? motor_of(joint) : nullptr;
    const bool pulls = (effects.drives && drive_of(joint) != nullptr) ||
                       (effects.springs && spring_of(joint) != nullptr);
    for (const int body : {base(joint).a, base(joint).b}) {
      if (body == kWorld) continue;
      MotorsOnBody& sum = on[index(body)];
      if (motor != nullptr) {
        (axes_of(joint)->slides ? sum.force : sum.torque) += motor->effort;
        sum.moves = sum.moves || motor->velocity != 0.0;
      }
      if (pulls) sum.moves = true;
    }
  }
  return on;
}

}  // namespace

Substep::Substep(const Scene& of)
    : scene(&of), inertia_inverse(inertia_inverses(of)), motors_on(motors_on_bodies(of)) {
  has_springs =
      of.effects.joints && std::any_of(of.joints.begin(), of.joints.end(), [](const Joint& joint) {
        return base(joint).compliance > 0.0 || angular_compliance_of(joint).value_or(0.0) > 0.0;
      });
  const std::size_t n = of.bodies.size();
  R_WB.resize(n);
  u_start.resize(n, Vec6::Zero());
  dt_before.resize(n);
  if (of.effects.joints && (of.effects.drives || of.effects.springs)) drives_on.resize(n);
  if (of.effects.joints && of.effects.armature) u_unstruck.resize(n);
  impulse_time.resize(n);
  u_before.resize(n);
  inverse_mass.resize(n);
}

void apply_forces(const Substep& sub, std::span<const double> time, std::span<Vec6> u) {
  for_each_force(sub.scene->effects, [&](auto force) {
    for (const int body : sub.part->moving) {
      const std::size_t i = index(body);
      force.accelerate(*sub.scene, sub.scene->bodies[i], sub.inertia_inverse[i], sub.R_WB[i],
                       time[i], u[i]);
    }
  });
}

double impulse_time_of(const Substep& sub, const Block& block) {
  return longest_of(block, sub.impulse_time);
}

double dt_previous_of(const State& state, const Block& block) {
  const double a = block.a < 0 ? 0.0 : state.dt_previous_of(index(block.a));
  const double b = block.b < 0 ? 0.0 : state.dt_previous_of(index(block.b));
  return std::max(a, b);
}

void find_lambda(const Substep& sub, const Block& block, double* lambda) {
  const double time = impulse_time_of(sub, block);
  for (int row = 0; row < block.rows; ++row) lambda[row] = block.impulse[row] / time;
}

bool springs_are_stored(const Substep& sub) {
  return sub.has_springs && drift_law(sub.settings) == Drift::kSoft;
}

}  // namespace substep
