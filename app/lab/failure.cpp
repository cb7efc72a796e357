#include "app/lab/failure.hpp"

#include <algorithm>

#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

// "joint gap 0.13 m" of "fails at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)".
std::string what_of(const std::string& verdict) {
  const std::size_t colon = verdict.find(": ");
  const std::string what = colon == std::string::npos ? "" : verdict.substr(colon + 2);
  return what.substr(0, what.find(" > "));
}

Failure torn_joint(const Scene& scene, const Poses& poses, int index) {
  const JointBase& j = base(scene.joints[static_cast<std::size_t>(index)]);
  const auto a = static_cast<std::size_t>(j.a);
  Failure failure;
  failure.joint = index;
  failure.name = j.name;
  failure.to = poses.x[a] + poses.q[a] * j.anchor_a;
  failure.from = j.anchor_b;
  failure.radius = radius_around(scene.bodies[a].shape);
  if (j.b != kWorld) {
    const auto b = static_cast<std::size_t>(j.b);
    failure.from = poses.x[b] + poses.q[b] * j.anchor_b;
    failure.radius = std::max(failure.radius, radius_around(scene.bodies[b].shape));
  }
  return failure;
}

Failure failed_body(const Scene& scene, const Poses& poses, int index) {
  const auto i = static_cast<std::size_t>(index);
  Failure failure;
  failure.body = index;
  failure.name = scene.bodies[i].name;
  failure.from = failure.to = poses.x[i];
  failure.radius = radius_around(scene.bodies[i].shape);
  return failure;
}

}  // namespace

// In the order in which the verdict judges.
std::optional<Failure> failure_of(const Scene& scene, const Poses& poses, const FrameReport& report,
                                  const Verdict& verdict) {
  if (verdict.holds()) return std::nullopt;
  const Criteria& criteria = scene.criteria;
  std::optional<Failure> failure;
  if (report.status != StepStatus::kOk) {
    if (report.failed_body >= 0) failure = failed_body(scene, poses, report.failed_body);
    return failure;  // the verdict's text is about numbers
  }
  const std::string what = what_of(verdict.text());
  if (report.joint_gap_joint >= 0 && report.joint_gap > criteria.joint_gap) {
    failure = torn_joint(scene, poses, report.joint_gap_joint);
  } else if (criteria.displacement && what.starts_with("moved")) {
    failure = failed_body(scene, poses, criteria.displacement->body);
  }
  if (failure) failure->words = what;
  return failure;
}

}  // namespace substep
