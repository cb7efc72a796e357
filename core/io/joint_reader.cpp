#include "core/io/joint_reader.hpp"

#include "core/io/body_reader.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

void read_bodies(ObjectReader& in, const BodyNames& bodies, JointBase& joint) {
  const auto a = bodies.read(in, "a", kRequired);
  const auto b = bodies.read(in, "b", kRequired);
  if (a) {
    const auto fault = side_fault(bodies.bodies(), *a, b.value_or(kWorld));
    if (fault) in.problem(fault->side, fault->message);
  }
  if (a && *a != kWorld) joint.a = *a;
  if (b) joint.b = *b;
}

void read_axis(ObjectReader& in, std::string_view key, Vec3& target) {
  Vec3 axis;
  if (!in.vector(key, symmetric(2.0, "-"), axis, kRequired)) return;
  if (const auto fault = axis_fault(axis)) {
    in.problem(key, *fault);
  } else {
    target = axis;
  }
}

void read_base(ObjectReader& in, const BodyNames& bodies, JointBase& joint) {
  read_bodies(in, bodies, joint);
  in.vector("anchor_a", kPositionRange, joint.anchor_a, kRequired);
  in.vector("anchor_b", kPositionRange, joint.anchor_b, kRequired);
  in.number("compliance", kComplianceRange, joint.compliance, kOptional);
}

}  // namespace

Joint read_joint(const Json& json, const std::string& pointer, const BodyNames& bodies,
                 Problems& problems) {
  ObjectReader in(json, pointer, problems);
  std::string name;
  std::string type;
  if (!in.is_object()) return {};
  in.text("name", kMaxNameSize, name, kRequired);
  if (!in.text("type", kMaxNameSize, type, kRequired)) return {};
  if (type == "ball") {
    BallJoint ball;
    ball.name = name;
    read_base(in, bodies, ball);
    in.finish();
    return ball;
  }
  if (type == "hinge") {
    HingeJoint hinge;
    hinge.name = name;
    read_base(in, bodies, hinge);
    read_axis(in, "axis_a", hinge.axis_a);
    read_axis(in, "axis_b", hinge.axis_b);
    in.number("angular_compliance", kAngularComplianceRange, hinge.angular_compliance, kOptional);
    in.finish();
    return hinge;
  }
  in.problem("type", value_text(type) + " is not ball or hinge");
  return {};
}

}  // namespace substep
