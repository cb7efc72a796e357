#include "app/lab/failure.hpp"

#include <algorithm>

#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

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
  const std::optional<Exceeded>& exceeded = verdict.exceeded();
  std::optional<Failure> failure;
  if (report.status != StepStatus::kOk) {
    if (report.failed_body >= 0) failure = failed_body(scene, poses, report.failed_body);
    return failure;
  }
  if (exceeded && exceeded->what == Exceeded::What::kJointGap && report.torn_joint >= 0) {
    failure = torn_joint(scene, poses, report.torn_joint);
  } else if (exceeded && exceeded->body >= 0) {
    failure = failed_body(scene, poses, exceeded->body);
  }
  if (failure && exceeded) failure->exceeded = *exceeded;
  return failure;
}

}  // namespace substep
