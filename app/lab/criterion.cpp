#include "app/lab/criterion.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "app/lab/stiffness.hpp"
#include "app/text/format.hpp"
#include "core/stepping/rotation_bound.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {
namespace {

const std::string& name_of_body(const Scene& scene, int body) {
  return scene.bodies[static_cast<std::size_t>(body)].name;
}

std::string speed_text(const Criterion& criterion) {
  return plain_number(criterion.angular_speed) + (criterion.remembered ? " rad/s now" : " rad/s");
}

}  // namespace

int Criterion::body() const {
  switch (set_by) {
    case CriterionTerm::kNone:
      return -1;
    case CriterionTerm::kStiffness:
      return stiffness.body;
    case CriterionTerm::kRotation:
      return rotation_body;
  }
  return -1;
}

Criterion criterion_of(const Scene& scene, const Settings& settings, const State& state,
                       const FrameReport& report) {
  Criterion c;
  const auto substeps = [&](double r) {
    return wanted_substeps(scene.frame, stable_step(settings.alpha, r));
  };
  c.rotation_on = settings.rotation_criterion;
  const std::vector<StiffnessLeader> list = stiffness_by_body(scene, state);
  if (!list.empty() && list.front().r > 0.0) {
    c.stiffness = list.front();
    c.n_stiffness = substeps(c.stiffness.r);
    c.set_by = CriterionTerm::kStiffness;
  }
  const auto body = static_cast<std::size_t>(std::max(report.rotation_body, 0));
  if (report.rotation_body < 0 || body >= state.u.size() || !(report.r_rotation > 0.0)) return c;
  c.rotation_body = report.rotation_body;
  c.r_rotation = report.r_rotation;
  c.angular_speed = state.u[body].tail<3>().norm();
  c.remembered = !state.rotation.empty() && state.rotation[body].now > 0.0;
  c.n_rotation = substeps(c.r_rotation);
  if (c.r_rotation > c.stiffness.r) c.set_by = CriterionTerm::kRotation;
  return c;
}

std::string degree_of_freedom(const StiffnessLeader& who) {
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  return std::string(who.dof < 3 ? "along " : "rotation about ") +
         kAxes[static_cast<std::size_t>(who.dof % 3)];
}

std::string setter_text(const Scene& scene, const Criterion& criterion) {
  switch (criterion.set_by) {
    case CriterionTerm::kNone:
      break;
    case CriterionTerm::kStiffness:
      return name_of_body(scene, criterion.stiffness.body) + ", " +
             degree_of_freedom(criterion.stiffness);
    case CriterionTerm::kRotation:
      return name_of_body(scene, criterion.rotation_body) + ", spinning at " +
             speed_text(criterion);
  }
  return "No geometric stiffness yet";
}

std::string stiffness_text(const Scene& scene, const Criterion& criterion) {
  if (criterion.stiffness.body < 0) return "Stiffness: none";
  return "Stiffness of " + name_of_body(scene, criterion.stiffness.body) + ", " +
         degree_of_freedom(criterion.stiffness);
}

std::string rotation_text(const Scene& scene, const Criterion& criterion) {
  if (!criterion.rotation_on) return "Rotation: switched off";
  if (criterion.rotation_body < 0) return "Rotation: no limit";
  return "Rotation of " + name_of_body(scene, criterion.rotation_body) + ", " +
         speed_text(criterion);
}

std::string rotation_meaning(const Scene& scene, const Criterion& criterion) {
  if (!criterion.rotation_on) return "Only the paper's rule sets N.";
  if (criterion.rotation_body < 0) return "No body rotates fast enough to matter.";
  const double degrees = criterion.angular_speed * scene.frame * 180.0 / std::numbers::pi;
  const std::string now = plain_number(degrees) + "° in a frame";
  if (!criterion.remembered) return "It turns " + now;
  return "Now " + now + "; the largest of the last " + plain_number(2.0 * kRotationWindow) +
         " s is used";
}

std::string both_terms_text(const Criterion& criterion) {
  return "stiffness alone N = " + grouped(criterion.n_stiffness) +
         ", rotation alone N = " + grouped(criterion.n_rotation);
}

}  // namespace substep
