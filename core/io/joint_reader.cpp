#include "core/io/joint_reader.hpp"

#include "core/io/body_reader.hpp"
#include "core/io/scene_limits.hpp"

namespace substep {
namespace {

void read_bodies(ObjectReader& in, const BodyNames& bodies, JointBase& joint) {
  const auto a = bodies.read(in, "a", kRequired);
  const auto b = bodies.read(in, "b", kRequired);
  if (a && *a == kWorld) {
    in.problem("a", "\"world\" never moves: a must move, b may be static or \"world\"");
  } else if (a && bodies.is_static(*a)) {
    in.problem("a", "this body is static: a must move, b may be static or \"world\"");
  } else if (a && b && *a == *b) {
    in.problem("b", "the same body as a");
  }
  if (a && *a != kWorld) joint.a = *a;
  if (b) joint.b = *b;
}

void read_axis(ObjectReader& in, std::string_view key, Vec3& target) {
  Vec3 axis;
  if (!in.vector(key, symmetric(2.0, "-"), axis, kRequired)) return;
  const double length = axis.norm();
  if (kUnitLength.contains(length)) {
    target = axis;
  } else {
    in.problem(key,
               "length " + number_text(length) + " is not 1 within " + number_text(kUnitTolerance));
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
