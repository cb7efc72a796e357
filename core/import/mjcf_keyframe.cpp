#include <algorithm>

#include "core/import/mjcf_model.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

using Kind = LinkJoint::Kind;

constexpr std::size_t kMostCoordinates = 200'000;

std::size_t coordinates(Kind kind) { return kind == Kind::kFree ? 7 : kind == Kind::kBall ? 4 : 1; }
std::size_t velocities(Kind kind) { return kind == Kind::kFree ? 6 : kind == Kind::kBall ? 3 : 1; }

Quat quat_at(const double* q) {
  const Quat turn(q[0], q[1], q[2], q[3]);
  return turn.norm() > 1e-10 ? turn.normalized() : Quat::Identity();
}

void set_start(Link& link, LinkJoint& joint, const double* q) {
  if (joint.kind == Kind::kFree) {
    link.free_start = Pose{Vec3(q), quat_at(q + 3)};
  } else if (joint.kind == Kind::kBall) {
    link.ball_start = quat_at(q);
  } else {
    joint.start = *q;
  }
}

void set_rate(Link& link, LinkJoint& joint, const double* v) {
  if (joint.kind == Kind::kFree) {
    link.free_velocity = Vec3(v);
    link.free_angular_velocity = Vec3(v + 3);
  } else if (joint.kind == Kind::kBall) {
    link.free_angular_velocity = Vec3(v);
  } else {
    joint.rate = *v;
  }
}

/// Hands the numbers of a keyframe to the joints, in their order.
void take(const MjcfContext& context, const XmlElement& element, MjcfModel& model) {
  MjcfAttributes in(context, element);
  in.ignore({"time"});
  const Range range = symmetric(1e6, "-");
  const std::vector<double> q = in.numbers("qpos", 1, kMostCoordinates, range);
  const std::vector<double> v = in.numbers("qvel", 1, kMostCoordinates, range);
  model.controls = in.numbers("ctrl", 1, kMostCoordinates, range);
  std::size_t n_q = 0;
  std::size_t n_v = 0;
  for (const Link& link : model.mechanism.links) {
    for (const LinkJoint& joint : link.joints) {
      n_q += coordinates(joint.kind);
      n_v += velocities(joint.kind);
    }
  }
  if ((!q.empty() && q.size() != n_q) || (!v.empty() && v.size() != n_v)) {
    return in.error("qpos must have " + std::to_string(n_q) + " numbers and qvel " +
                    std::to_string(n_v));
  }
  std::size_t at_q = 0;
  std::size_t at_v = 0;
  for (Link& link : model.mechanism.links) {
    for (LinkJoint& joint : link.joints) {
      if (!q.empty()) set_start(link, joint, q.data() + at_q);
      if (!v.empty()) set_rate(link, joint, v.data() + at_v);
      at_q += coordinates(joint.kind);
      at_v += velocities(joint.kind);
    }
  }
}

}  // namespace

void read_keyframe(const MjcfContext& context, const std::string& key, MjcfModel& model) {
  std::vector<std::string> names;
  bool is_taken = false;
  for (const XmlElement& section : context.document.root.children) {
    if (section.name != "keyframe") continue;
    for (const XmlElement& element : section.children) {
      const std::string* given = element.attribute("name");
      names.push_back(given != nullptr && !given->empty() ? *given
                                                          : std::to_string(names.size() + 1));
      if (is_taken || key.empty() || names.back() != key) continue;
      take(context, element, model);
      is_taken = true;
    }
  }
  std::string list;
  for (const std::string& name : names) list.append(list.empty() ? "" : ", ").append(name);
  if (!key.empty() && !is_taken) {
    context.report.errors.add(
        context.document.files.front(),
        "no keyframe is called '" + key + "'" + (list.empty() ? "" : "; there are: " + list));
  }
  if (is_taken) context.report.came_in.push_back("start: keyframe " + key);
  if (key.empty()) context.report.starts = list;
}

}  // namespace substep
