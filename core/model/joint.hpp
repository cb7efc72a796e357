#pragma once

#include <optional>
#include <string>
#include <variant>

#include "core/math/types.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {

inline constexpr int kWorld = -1;  ///< body b of a joint fixed in the world

/// Members common to all joints. Body a moves; body b may be moving, static, or kWorld.
struct JointBase {
  std::string name;
  int a = 0;                     // index into Scene::bodies
  int b = kWorld;                // index into Scene::bodies, or kWorld
  Vec3 anchor_a = Vec3::Zero();  // in the frame of a [m]
  Vec3 anchor_b = Vec3::Zero();  // in the frame of b, or in the world for kWorld [m]
  double compliance = 0.0;       // C of the positional rows [m/N], >= 0

  static constexpr bool kSlides = false;   // true if the anchors may separate along the axis
  static constexpr bool kCrosses = false;  // true if the axes stay perpendicular, not parallel
};

// Each type has kType, its name in files, and own_fields(), which lists its members beyond
// JointBase for reading, writing and checking: field(key, direction) for each unit vector,
// field(key, number, range) for each number, which may be optional, and field(key, part) for each
// optional part, which has own_fields() too.

/// Bounds of the angle of a hinge, the travel of a slide or the length of a rope.
struct Limit {
  double lower = 0.0;        // [rad or m]
  double upper = 0.0;        // above lower [rad or m]
  double restitution = 0.0;  // [-]
};

/// The directions from which the angle of a hinge is measured: it is the rotation of across_a from
/// across_b about the axis.
struct AngleZero {
  Vec3 across_a = Vec3::UnitX();  // unit, perpendicular to axis_a, in the frame of a [-]
  Vec3 across_b = Vec3::UnitX();  // unit, perpendicular to axis_b, in the frame of b [-]

  template <class Part, class Field>
  static void own_fields(Part& zero, Field&& field) {
    field("across_a", zero.across_a);
    field("across_b", zero.across_b);
  }
};

/// The range of the angle is less than a full turn.
struct AngleLimit : Limit, AngleZero {
  template <class Part, class Field>
  static void own_fields(Part& limit, Field&& field) {
    field("lower", limit.lower, kAngleRange);
    field("upper", limit.upper, kAngleRange);
    field("restitution", limit.restitution, kRestitutionRange);
    AngleZero::own_fields(limit, field);
  }
};

/// The travel is that of the anchor on a from the anchor on b along the axis.
struct TravelLimit : Limit {
  template <class Part, class Field>
  static void own_fields(Part& limit, Field&& field) {
    field("lower", limit.lower, kPositionRange);
    field("upper", limit.upper, kPositionRange);
    field("restitution", limit.restitution, kRestitutionRange);
  }
};

/// Moves a relative to b about or along the axis of their joint, with as much effort as it has.
struct Motor {
  double velocity = 0.0;  // [rad/s or m/s]
  double effort = 1.0;    // largest torque or force, > 0 [N m or N]
};

struct AngularMotor : Motor {
  template <class Part, class Field>
  static void own_fields(Part& motor, Field&& field) {
    field("velocity", motor.velocity, kAngularVelocityRange);
    field("torque", motor.effort, kMotorTorqueRange);
  }
};

struct LinearMotor : Motor {
  template <class Part, class Field>
  static void own_fields(Part& motor, Field&& field) {
    field("velocity", motor.velocity, kVelocityRange);
    field("force", motor.effort, kMotorForceRange);
  }
};

/// A passive spring and damper of a joint's coordinate x: stiffness (rest - x) - damping dx/dt.
struct Spring {
  double rest = 0.0;       // [rad or m]
  double stiffness = 0.0;  // >= 0; it or the damping is above 0 [N m/rad or N/m]
  double damping = 0.0;    // >= 0 [N m s/rad or N s/m]
};

/// The angle is that of AngularDrive.
struct AngularSpring : Spring, AngleZero {
  template <class Part, class Field>
  static void own_fields(Part& spring, Field&& field) {
    field("rest", spring.rest, kDriveAngleRange);
    field("stiffness", spring.stiffness, kDriveTurningStiffnessRange);
    field("damping", spring.damping, kDriveTurningDampingRange);
    AngleZero::own_fields(spring, field);
  }
};

/// The travel is that of TravelLimit.
struct LinearSpring : Spring {
  template <class Part, class Field>
  static void own_fields(Part& spring, Field&& field) {
    field("rest", spring.rest, kPositionRange);
    field("stiffness", spring.stiffness, kDriveStiffnessRange);
    field("damping", spring.damping, kDriveDampingRange);
  }
};

/// A spring and damper towards a target of a joint's coordinate x, with as much effort as it has:
///   stiffness (target - x) + damping (velocity - dx/dt).
struct Drive {
  double target = 0.0;                // [rad or m]
  double velocity = 0.0;              // [rad/s or m/s]
  double stiffness = 0.0;             // >= 0; it or the damping is above 0 [N m/rad or N/m]
  double damping = 0.0;               // >= 0 [N m s/rad or N s/m]
  std::optional<double> effort = {};  // largest torque or force, > 0; none: unbounded [N m or N]
};

/// The angle is that of AngleLimit, but not bounded: it counts full turns. At the start it is from
/// -pi to pi.
struct AngularDrive : Drive, AngleZero {
  template <class Part, class Field>
  static void own_fields(Part& drive, Field&& field) {
    field("target", drive.target, kDriveAngleRange);
    field("velocity", drive.velocity, kAngularVelocityRange);
    field("stiffness", drive.stiffness, kDriveTurningStiffnessRange);
    field("damping", drive.damping, kDriveTurningDampingRange);
    field("torque", drive.effort, kMotorTorqueRange);
    AngleZero::own_fields(drive, field);
  }
};

/// The travel is that of TravelLimit.
struct LinearDrive : Drive {
  template <class Part, class Field>
  static void own_fields(Part& drive, Field&& field) {
    field("target", drive.target, kPositionRange);
    field("velocity", drive.velocity, kVelocityRange);
    field("stiffness", drive.stiffness, kDriveStiffnessRange);
    field("damping", drive.damping, kDriveDampingRange);
    field("force", drive.effort, kMotorForceRange);
  }
};

/// The two anchors coincide: 3 rows.
struct BallJoint : JointBase {
  static constexpr const char* kType = "ball";

  template <class J, class Field>
  static void own_fields(J&, Field&&) {}
};

/// The two anchors coincide and the two axes stay parallel: 5 rows.
struct HingeJoint : JointBase {
  static constexpr const char* kType = "hinge";
  Vec3 axis_a = Vec3::UnitZ();      // unit, in the frame of a [-]
  Vec3 axis_b = Vec3::UnitZ();      // unit, in the frame of b, or in the world for kWorld [-]
  double angular_compliance = 0.0;  // C of the two angular rows [rad/(N m)], >= 0
  std::optional<AngleLimit> limit;
  std::optional<AngularMotor> motor;
  std::optional<AngularDrive> drive;
  std::optional<AngularSpring> spring;
  std::optional<double> friction;  // dry: largest torque about the axis, > 0 [N m]
  std::optional<double> armature;  // inertia of the angle, besides that of the bodies [kg m^2]

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("axis_a", joint.axis_a);
    field("axis_b", joint.axis_b);
    field("angular_compliance", joint.angular_compliance, kAngularComplianceRange);
    field("limit", joint.limit);
    field("motor", joint.motor);
    field("drive", joint.drive);
    field("spring", joint.spring);
    field("friction", joint.friction, kMotorTorqueRange);
    field("armature", joint.armature, kInertiaRange);
  }
};

/// A joint that fixes the relative orientation: its axes and the directions perpendicular to them
/// stay parallel.
struct OrientedJoint : JointBase {
  Vec3 axis_a = Vec3::UnitX();      // unit, in the frame of a [-]
  Vec3 axis_b = Vec3::UnitX();      // unit, in the frame of b, or in the world for kWorld [-]
  Vec3 across_a = Vec3::UnitY();    // unit, perpendicular to axis_a [-]
  Vec3 across_b = Vec3::UnitY();    // unit, perpendicular to axis_b [-]
  double angular_compliance = 0.0;  // C of the three angular rows [rad/(N m)], >= 0

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("axis_a", joint.axis_a);
    field("axis_b", joint.axis_b);
    field("across_a", joint.across_a);
    field("across_b", joint.across_b);
    field("angular_compliance", joint.angular_compliance, kAngularComplianceRange);
  }
};

/// The anchor on a slides along the axis through the anchor on b: 5 rows.
struct PrismaticJoint : OrientedJoint {
  static constexpr const char* kType = "prismatic";
  static constexpr bool kSlides = true;
  std::optional<TravelLimit> limit;
  std::optional<LinearMotor> motor;
  std::optional<LinearDrive> drive;
  std::optional<LinearSpring> spring;
  std::optional<double> friction;  // dry: largest force along the axis, > 0 [N]
  std::optional<double> armature;  // inertia of the travel, besides that of the bodies [kg]

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    OrientedJoint::own_fields(joint, field);
    field("limit", joint.limit);
    field("motor", joint.motor);
    field("drive", joint.drive);
    field("spring", joint.spring);
    field("friction", joint.friction, kMotorForceRange);
    field("armature", joint.armature, kMassRange);
  }
};

/// The two anchors coincide: 6 rows.
struct WeldJoint : OrientedJoint {
  static constexpr const char* kType = "weld";
};

/// The two anchors keep their distance, like a rod without mass; with compliance a spring of that
/// free length. 1 row.
struct DistanceJoint : JointBase {
  static constexpr const char* kType = "distance";
  double length = 1.0;  // [m], > 0

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("length", joint.length, kSizeRange);
  }
};

/// The two anchors coincide and the two axes stay perpendicular, like the pins of a cross: 4 rows.
struct UniversalJoint : JointBase {
  static constexpr const char* kType = "universal";
  static constexpr bool kCrosses = true;
  Vec3 axis_a = Vec3::UnitX();      // unit, in the frame of a [-]
  Vec3 axis_b = Vec3::UnitY();      // unit, in the frame of b, or in the world for kWorld [-]
  double angular_compliance = 0.0;  // C of the angular row [rad/(N m)], >= 0

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("axis_a", joint.axis_a);
    field("axis_b", joint.axis_b);
    field("angular_compliance", joint.angular_compliance, kAngularComplianceRange);
  }
};

/// The anchor on a slides along the axis through the anchor on b, and a turns about it: 4 rows.
struct CylindricalJoint : JointBase {
  static constexpr const char* kType = "cylindrical";
  static constexpr bool kSlides = true;
  Vec3 axis_a = Vec3::UnitZ();      // unit, in the frame of a [-]
  Vec3 axis_b = Vec3::UnitZ();      // unit, in the frame of b, or in the world for kWorld [-]
  double angular_compliance = 0.0;  // C of the two angular rows [rad/(N m)], >= 0
  // Of the travel; the angle is free.
  std::optional<TravelLimit> limit;
  std::optional<LinearMotor> motor;
  std::optional<LinearDrive> drive;
  std::optional<LinearSpring> spring;
  std::optional<double> friction;  // dry: largest force along the axis, > 0 [N]
  std::optional<double> armature;  // inertia of the travel, besides that of the bodies [kg]

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("axis_a", joint.axis_a);
    field("axis_b", joint.axis_b);
    field("angular_compliance", joint.angular_compliance, kAngularComplianceRange);
    field("limit", joint.limit);
    field("motor", joint.motor);
    field("drive", joint.drive);
    field("spring", joint.spring);
    field("friction", joint.friction, kMotorForceRange);
    field("armature", joint.armature, kMassRange);
  }
};

/// The two anchors are at most a length apart, like those of a rope without mass: slack below it,
/// where no force acts, and taut at it. It has no rows but those of its limit.
struct RopeJoint : JointBase {
  static constexpr const char* kType = "rope";
  std::optional<Limit> limit = Limit{.upper = 1.0};  // of the distance [m]; upper is the length

  template <class J, class Field>
  static void own_fields(J& joint, Field&& field) {
    field("length", joint.limit->upper, kSizeRange);
    field("restitution", joint.limit->restitution, kRestitutionRange);
  }
};

using Joint = std::variant<BallJoint, HingeJoint, PrismaticJoint, WeldJoint, DistanceJoint,
                           UniversalJoint, CylindricalJoint, RopeJoint>;

inline const JointBase& base(const Joint& joint) {
  return std::visit([](const auto& j) -> const JointBase& { return j; }, joint);
}
inline JointBase& base(Joint& joint) {
  return std::visit([](auto& j) -> JointBase& { return j; }, joint);
}

}  // namespace substep
