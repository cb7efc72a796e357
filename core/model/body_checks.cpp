#include "core/model/body_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/joint_fields.hpp"
#include "core/model/number_checks.hpp"
#include "core/model/types_in_files.hpp"

namespace substep {
namespace {

std::string not_unit_text(double length) {
  return "must have length 1 within " + number_text(kUnitTolerance) + ", not " +
         number_text(length);
}

struct ShapeFieldCheck {
  const DataPlace& place;
  Problems& problems;

  void operator()(const char* key, double number, const Range& range, double factor) const {
    check_number(factor * number, range, place.at(key), problems);
  }
  void operator()(const char* key, const Vec3& numbers, const Range& range, double factor) const {
    check_numbers(factor * numbers, range, place.at(key), problems);
  }
};

void check_shape(const Body& body, const DataPlace& place, Problems& problems) {
  if (const auto fault = motion_fault(body.shape, body.is_static)) {
    problems.push_back({place.at("type").pointer(), *fault});
  }
  const ShapeFieldCheck check{place, problems};
  std::visit([&](const auto& own) { own.own_fields(own, check); }, body.shape);
}

void check_motion(const Body& body, const DataPlace& place, Problems& problems) {
  for (const auto& [key, member, range] : kMotionFields) {
    const DataPlace there = place.at(key);
    if (!body.is_static) {
      check_numbers(body.*member, range, there, problems);
    } else if (!(body.*member == Vec3::Zero())) {
      problems.push_back({there.pointer(), std::string(kStaticMoves)});
    }
  }
}

void check_mass(const Body& body, const DataPlace& place, Problems& problems) {
  check_number(body.mass, kMassRange, place.at("mass"), problems);
  const DataPlace there = place.at("inertia");
  const std::size_t before = problems.size();
  check_numbers(body.inertia, kInertiaRange, there, problems);
  if (problems.size() > before) return;
  if (const auto fault = inertia_fault(body.inertia)) problems.push_back({there.pointer(), *fault});
}

struct OwnFieldCheck {
  const DataPlace& place;
  Problems& problems;

  void operator()(const char* key, const Vec3& axis) const {
    if (const auto fault = axis_fault(axis)) problems.push_back({place.at(key).pointer(), *fault});
  }
  void operator()(const char* key, double number, const Range& range) const {
    check_number(number, range, place.at(key), problems);
  }
  void operator()(const char* key, const std::optional<double>& number, const Range& range) const {
    if (number) check_number(*number, range, place.at(key), problems);
  }
  template <class Part>
  void operator()(const char* key, const std::optional<Part>& part) const {
    const DataPlace there = place.at(key);
    if (part) Part::own_fields(*part, OwnFieldCheck{there, problems});
  }
};

}  // namespace

std::optional<std::string> motion_fault(const Shape& shape, bool is_static) {
  if (is_static || std::visit([](const auto& s) { return s.kMoves; }, shape)) return std::nullopt;
  return "a " + std::string(kTypes<Shape>[shape.index()]) +
         " cannot move: its body needs \"static\": true";
}

std::optional<std::string> inertia_fault(const Vec3& inertia) {
  Vec3 moments = inertia;
  std::sort(moments.data(), moments.data() + 3);
  const double sum = moments[0] + moments[1];
  // A flat body reaches equality: leave room for rounding.
  if (!(moments[2] > sum * (1.0 + 1e-9))) return std::nullopt;
  return "no body has these moments: " + number_text(moments[2]) +
         " is more than the sum of the other two, " + number_text(sum) + " (kg m^2)";
}

std::optional<std::string> orientation_fault(const Quat& q) {
  const double numbers[] = {q.w(), q.x(), q.y(), q.z()};
  const double length = std::sqrt(q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
  if (kUnitLength.contains(length)) return std::nullopt;
  std::string message = not_unit_text(length);
  if (length > kUnitTolerance && std::isfinite(length)) {
    message += "; at length 1 it is [";
    for (int i = 0; i < 4; ++i) message += (i > 0 ? ", " : "") + number_text(numbers[i] / length);
    message += "]";
  }
  return message;
}

std::optional<std::string> axis_fault(const Vec3& axis) {
  const double length = axis.norm();
  if (kUnitLength.contains(length)) return std::nullopt;
  return not_unit_text(length);
}

namespace {

std::optional<std::string> across_axis_fault(const Vec3& axis, const Vec3& v) {
  const double cosine = std::abs(axis.dot(v));
  if (cosine <= kUnitTolerance) return std::nullopt;
  return "must be perpendicular to the axis: the cosine of their angle is " + number_text(cosine) +
         ", which is more than " + number_text(kUnitTolerance);
}

/// Of the directions from which the angle of a hinge is measured.
std::optional<JointFault> zero_fault(std::string_view key, const JointAxes& axes,
                                     const AngleZero& directions) {
  if (const auto fault = across_axis_fault(axes.a, directions.across_a)) {
    return JointFault{key, "across_a " + *fault};
  }
  if (const auto fault = across_axis_fault(axes.b, directions.across_b)) {
    return JointFault{key, "across_b " + *fault};
  }
  return std::nullopt;
}

std::optional<JointFault> limit_fault(const JointAxes& axes, const AngleLimit& limit) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (!(limit.upper - limit.lower < kTurn)) {
    return JointFault{"limit", "upper and lower must be less than a full turn apart, not " +
                                   number_text(limit.upper - limit.lower) + " (rad)"};
  }
  return zero_fault("limit", axes, limit);
}

std::optional<JointFault> drive_fault(const Joint& joint, const JointAxes& axes) {
  const Drive* drive = drive_of(joint);
  if (drive == nullptr) return std::nullopt;
  if (drive->stiffness == 0.0 && drive->damping == 0.0)
    return JointFault{"drive", "stiffness or damping must be above 0"};
  const AngularDrive* angular = angular_drive_of(joint);
  return angular != nullptr ? zero_fault("drive", axes, *angular) : std::nullopt;
}

std::optional<JointFault> spring_fault(const Joint& joint, const JointAxes& axes) {
  const Spring* spring = spring_of(joint);
  if (spring == nullptr) return std::nullopt;
  if (spring->stiffness == 0.0 && spring->damping == 0.0)
    return JointFault{"spring", "stiffness or damping must be above 0"};
  const AngularSpring* angular = angular_spring_of(joint);
  return angular != nullptr ? zero_fault("spring", axes, *angular) : std::nullopt;
}

}  // namespace

std::optional<JointFault> joint_fault(const Joint& joint) {
  if (rope_length_of(joint) && base(joint).compliance != 0.0) {
    return JointFault{"compliance", "a rope does not stretch: it must be 0, not " +
                                        number_text(base(joint).compliance)};
  }
  const auto axes = axes_of(joint);
  if (!axes) return std::nullopt;
  if (const Limit* limit = limit_of(joint); limit != nullptr && !(limit->lower < limit->upper)) {
    return JointFault{"limit", "upper must be above lower, " + number_text(limit->lower) +
                                   ", not " + number_text(limit->upper)};
  }
  if (const AngleLimit* limit = angle_limit_of(joint)) {
    if (auto fault = limit_fault(*axes, *limit)) return fault;
  }
  if (auto fault = drive_fault(joint, *axes)) return fault;
  if (auto fault = spring_fault(joint, *axes)) return fault;
  const auto across = across_of(joint);
  if (!across) return std::nullopt;
  if (const auto fault = across_axis_fault(axes->a, across->a))
    return JointFault{"across_a", *fault};
  if (const auto fault = across_axis_fault(axes->b, across->b))
    return JointFault{"across_b", *fault};
  return std::nullopt;
}

std::optional<std::string> body_fault(const std::vector<Body>& bodies, int body,
                                      std::string_view or_else) {
  if (bodies.empty()) return "the scene has no bodies";
  if (body >= 0 && index(body) < bodies.size()) return std::nullopt;
  const std::string last = std::to_string(bodies.size() - 1);
  return must_be("the index of a body, from 0 to " + last + std::string(or_else),
                 std::to_string(body));
}

std::optional<JointFault> side_fault(const std::vector<Body>& bodies, int a, int b) {
  if (a == kWorld && !bodies.empty()) {
    return JointFault{"a", "must be a moving body, not \"world\"; b may be static or \"world\""};
  }
  if (const auto fault = body_fault(bodies, a)) return JointFault{"a", *fault};
  if (const auto fault = body_fault(bodies, b, ", or -1 for the world"); fault && b != kWorld) {
    return JointFault{"b", *fault};
  }
  if (bodies[index(a)].is_static) {
    return JointFault{"a", "must be a moving body, not a static one; b may be static or \"world\""};
  }
  if (a == b) return JointFault{"b", "must be a different body from a"};
  return std::nullopt;
}

void check_body(const Body& body, const DataPlace& place, Problems& problems) {
  check_shape(body, place.at("shape"), problems);
  if (!body.is_static) check_mass(body, place, problems);
  check_numbers(body.position, kPositionRange, place.at("position"), problems);
  if (const auto fault = orientation_fault(body.orientation)) {
    problems.push_back({place.at("orientation").pointer(), *fault});
  }
  check_motion(body, place, problems);
  check_number(body.friction, kFrictionRange, place.at("friction"), problems);
  check_number(body.restitution, kRestitutionRange, place.at("restitution"), problems);
  if (body.collision_group < -1 || body.collision_group > kMaxCollisionGroup) {
    problems.push_back({place.at("collision_group").pointer(),
                        must_be("a whole number from 0 to " + std::to_string(kMaxCollisionGroup) +
                                    ", or -1 for none",
                                std::to_string(body.collision_group))});
  }
}

void check_joint(const Joint& joint, const std::vector<Body>& bodies, const DataPlace& place,
                 Problems& problems) {
  const JointBase& j = base(joint);
  if (const auto fault = side_fault(bodies, j.a, j.b)) {
    problems.push_back({place.at(fault->key).pointer(), fault->message});
  }
  check_numbers(j.anchor_a, kPositionRange, place.at("anchor_a"), problems);
  check_numbers(j.anchor_b, kPositionRange, place.at("anchor_b"), problems);
  check_number(j.compliance, kComplianceRange, place.at("compliance"), problems);
  std::visit([&](const auto& own) { own.own_fields(own, OwnFieldCheck{place, problems}); }, joint);
  if (const auto fault = joint_fault(joint)) {
    problems.push_back({place.at(fault->key).pointer(), fault->message});
  }
}

}  // namespace substep
