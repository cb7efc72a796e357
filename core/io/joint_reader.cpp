#include "core/io/joint_reader.hpp"

#include "core/io/body_reader.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/joint_fields.hpp"
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

struct OwnFieldReader {
  ObjectReader& in;

  void operator()(std::string_view key, Vec3& axis) const { read_axis(in, key, axis); }
  void operator()(std::string_view key, double& number, const Range& range) const {
    in.number(key, range, number, kOptional);
  }
};

}  // namespace

Joint read_joint(const Json& json, const std::string& pointer, const BodyNames& bodies,
                 Problems& problems) {
  const std::size_t before = problems.size();
  ObjectReader in(json, pointer, problems);
  std::string name;
  if (!in.is_object()) return {};
  in.text("name", kMaxNameSize, name, kRequired);
  const auto type = in.choice("type", kJointTypes, kRequired);
  if (!type) return {};
  Joint joint = make_joint(*type);
  base(joint).name = name;
  read_base(in, bodies, base(joint));
  std::visit([&](auto& own) { own_fields(own, OwnFieldReader{in}); }, joint);
  if (problems.size() == before) {
    if (const auto fault = across_fault(joint)) in.problem(fault->key, fault->message);
  }
  in.finish();
  return joint;
}

}  // namespace substep
