#include "core/io/item_reader.hpp"

#include <charconv>
#include <cstdint>
#include <string>

#include "core/io/object_reader.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/types_in_files.hpp"

namespace substep {
namespace {

struct ShapeFieldReader {
  ObjectReader& in;

  void operator()(std::string_view key, double& target, const Range& range, double factor) const {
    if (in.number(key, range, target, kRequired)) target /= factor;
  }
  void operator()(std::string_view key, Vec3& target, const Range& range, double factor) const {
    if (in.vector(key, range, target, kRequired)) target /= factor;
  }
};

Shape read_shape(const Json& json, const std::string& pointer, bool is_static, Problems& problems) {
  ObjectReader in(json, pointer, problems);
  const auto type = in.choice("type", kTypes<Shape>, kRequired);
  if (!type) return {};
  auto shape = make_type<Shape>(*type);
  if (const auto fault = motion_fault(shape, is_static)) in.problem("type", *fault);
  std::visit([&](auto& own) { own.own_fields(own, ShapeFieldReader{in}); }, shape);
  in.finish();
  return shape;
}

/// A quaternion is taken as it is written: not normalised, so that a file keeps its bits.
void read_orientation(ObjectReader& in, Quat& target) {
  double q[4] = {1.0, 0.0, 0.0, 0.0};
  if (!in.numbers("orientation", symmetric(2.0, "-"), q, 4, kOptional)) return;
  const Quat orientation(q[0], q[1], q[2], q[3]);
  if (const auto fault = orientation_fault(orientation)) {
    in.problem("orientation", *fault);
    return;
  }
  target = orientation;
}

void read_mass(ObjectReader& in, std::size_t problems_of_shape, Body& body) {
  const bool has_mass = in.number("mass", kMassRange, body.mass, kRequired);
  const bool given = in.vector("inertia", kInertiaRange, body.inertia, kOptional);
  if (!given) {
    if (!has_mass || problems_of_shape > 0) return;
    body.inertia = solid_inertia(body.shape, body.mass);
    for (const double moment : body.inertia) {
      if (kInertiaRange.contains(moment)) continue;
      in.problem("inertia", "that of the mass and the shape " +
                                must_be(kInertiaRange.violated_by(moment), number_text(moment)));
      break;
    }
    return;
  }
  if (const auto fault = inertia_fault(body.inertia)) in.problem("inertia", *fault);
}

/// "#rrggbb", as in CSS.
void read_color(ObjectReader& in, Body& body) {
  std::string text;
  if (!in.text("color", kMaxNameSize, text, kOptional)) return;
  std::uint32_t value = 0;
  const char* begin = text.data() + 1;
  const char* end = text.data() + text.size();
  const bool shaped = text.size() == 7 && text[0] == '#';
  if (!shaped || std::from_chars(begin, end, value, 16).ptr != end) {
    in.problem("color", must_be("a colour like \"#ff8800\"", value_text(text)));
    return;
  }
  body.color = value;
}

void refuse(ObjectReader& in, std::string_view key, const std::string& why) {
  if (in.member(key, kOptional)) in.problem(key, why);
}

void read_bodies(ObjectReader& in, const BodyNames& bodies, JointBase& joint) {
  const auto a = bodies.read(in, "a", kRequired);
  const auto b = bodies.read(in, "b", kRequired);
  if (a) {
    const auto fault = side_fault(bodies.bodies(), *a, b.value_or(kWorld));
    if (fault) in.problem(fault->key, fault->message);
  }
  if (a && *a != kWorld) joint.a = *a;
  if (b) joint.b = *b;
}

struct OwnFieldReader {
  ObjectReader& in;

  void operator()(std::string_view key, Vec3& target) const {
    Vec3 axis;
    if (!in.vector(key, symmetric(2.0, "-"), axis, kRequired)) return;
    if (const auto fault = axis_fault(axis)) {
      in.problem(key, *fault);
    } else {
      target = axis;
    }
  }
  void operator()(std::string_view key, double& number, const Range& range) const {
    // One that may not be 0 has no default.
    in.number(key, range, number, range.contains(0.0) ? kOptional : kRequired);
  }
  void operator()(std::string_view key, std::optional<double>& number, const Range& range) const {
    double given = 0.0;
    if (in.number(key, range, given, kOptional)) number = given;
  }
  template <class Part>
  void operator()(std::string_view key, std::optional<Part>& target) const {
    const Json* json = in.member(key, kOptional);
    if (json == nullptr) return;
    ObjectReader inner = in.inner(key, *json);
    Part part;
    if (inner.is_object()) {
      Part::own_fields(part, OwnFieldReader{inner});
      inner.finish();
    }
    target = part;
  }
};

}  // namespace

Body read_body(const Json& json, const std::string& pointer, Problems& problems) {
  Body body;
  ObjectReader in(json, pointer, problems);
  if (!in.is_object()) return body;
  in.text("name", kMaxNameSize, body.name, kRequired);
  in.flag("static", body.is_static, kOptional);
  const std::size_t problems_before = problems.size();
  if (const Json* shape = in.member("shape", kRequired)) {
    body.shape = read_shape(*shape, in.pointer("shape"), body.is_static, problems);
  }
  const std::size_t problems_of_shape = problems.size() - problems_before;
  if (body.is_static) {
    refuse(in, "mass", "a static body has no mass");
    refuse(in, "inertia", "a static body has no inertia");
  } else {
    read_mass(in, problems_of_shape, body);
  }
  in.vector("position", kPositionRange, body.position, kRequired);
  read_orientation(in, body.orientation);
  for (const auto& [key, member, range] : kMotionFields) {
    if (body.is_static) {
      refuse(in, key, std::string(kStaticMoves));
    } else {
      in.vector(key, range, body.*member, kOptional);
    }
  }
  in.number("friction", kFrictionRange, body.friction, kOptional);
  in.number("restitution", kRestitutionRange, body.restitution, kOptional);
  in.integer("collision_group", 0, kMaxCollisionGroup, body.collision_group, kOptional);
  in.flag("collides", body.collides, kOptional);
  read_color(in, body);
  in.finish();
  return body;
}

Joint read_joint(const Json& json, const std::string& pointer, const BodyNames& bodies,
                 Problems& problems) {
  const std::size_t before = problems.size();
  ObjectReader in(json, pointer, problems);
  std::string name;
  if (!in.is_object()) return {};
  in.text("name", kMaxNameSize, name, kRequired);
  const auto type = in.choice("type", kTypes<Joint>, kRequired);
  if (!type) return {};
  auto joint = make_type<Joint>(*type);
  JointBase& j = base(joint);
  j.name = name;
  read_bodies(in, bodies, j);
  in.vector("anchor_a", kPositionRange, j.anchor_a, kRequired);
  in.vector("anchor_b", kPositionRange, j.anchor_b, kRequired);
  in.number("compliance", kComplianceRange, j.compliance, kOptional);
  std::visit([&](auto& own) { own.own_fields(own, OwnFieldReader{in}); }, joint);
  if (problems.size() == before) {
    if (const auto fault = joint_fault(joint)) in.problem(fault->key, fault->message);
  }
  in.finish();
  return joint;
}

}  // namespace substep
