#pragma once
// Members that only some joints have.

#include <optional>
#include <variant>

#include "core/model/joint.hpp"

namespace substep {

/// The two axes that a joint keeps parallel or perpendicular, in the frames of its bodies.
struct JointAxes {
  Vec3 a = Vec3::UnitZ();
  Vec3 b = Vec3::UnitZ();
  bool slides = false;  // true if the anchors may separate along them
};

/// The directions perpendicular to its axes that a joint keeps parallel, or nothing.
inline std::optional<JointAxes> across_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<JointAxes> {
        if constexpr (requires { j.across_a; }) return JointAxes{j.across_a, j.across_b};
        return std::nullopt;
      },
      joint);
}

/// The axes that a joint keeps parallel, or nothing.
inline std::optional<JointAxes> axes_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<JointAxes> {
        if constexpr (requires { j.axis_a; }) {
          if (!j.kCrosses) return JointAxes{j.axis_a, j.axis_b, j.kSlides};
        }
        return std::nullopt;
      },
      joint);
}

/// The axes that a joint keeps perpendicular, or nothing.
inline std::optional<JointAxes> crossing_axes_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<JointAxes> {
        if constexpr (requires { j.axis_a; }) {
          if (j.kCrosses) return JointAxes{j.axis_a, j.axis_b};
        }
        return std::nullopt;
      },
      joint);
}

/// The distance that a joint keeps between its anchors [m]; nothing if they coincide or slide.
inline std::optional<double> length_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<double> {
        if constexpr (requires { j.length; }) return j.length;
        return std::nullopt;
      },
      joint);
}

/// The largest distance of a joint's anchors [m]; nothing if it is no rope.
inline std::optional<double> rope_length_of(const Joint& joint) {
  const auto* rope = std::get_if<RopeJoint>(&joint);
  if (rope == nullptr) return std::nullopt;
  return rope->limit->upper;
}

/// True if a joint fixes the position and the orientation of its bodies relative to each other.
inline bool is_weld(const Joint& joint) {
  const std::optional<JointAxes> axes = axes_of(joint);
  return axes && !axes->slides && across_of(joint);
}

/// The error part of the vector between a joint's anchors: all of it, for a sliding joint the
/// component perpendicular to the axis, and for a distance joint or a rope what exceeds its length.
/// @param apart from the anchor on b to that on a, world [m]  @param q_b orientation of b
inline Vec3 gap_of(const Joint& joint, const Vec3& apart, const Quat& q_b) {
  if (const std::optional<double> length = length_of(joint)) {
    const double distance = apart.norm();
    return distance > 0.0 ? Vec3((1.0 - *length / distance) * apart) : Vec3(*length, 0.0, 0.0);
  }
  if (const std::optional<double> length = rope_length_of(joint)) {
    const double distance = apart.norm();
    return distance > *length ? Vec3((1.0 - *length / distance) * apart) : Vec3(Vec3::Zero());
  }
  const std::optional<JointAxes> axes = axes_of(joint);
  if (!axes || !axes->slides) return apart;
  const Vec3 axis = q_b * axes->b;
  return apart - axis * axis.dot(apart);
}

/// C of a joint's angular rows [rad/(N m)]; nothing if it has none.
inline std::optional<double> angular_compliance_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<double> {
        if constexpr (requires { j.angular_compliance; }) return j.angular_compliance;
        return std::nullopt;
      },
      joint);
}

/// The limit of a joint's coordinate, or null.
inline const Limit* limit_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> const Limit* {
        if constexpr (requires { j.limit; }) return j.limit ? &*j.limit : nullptr;
        return nullptr;
      },
      joint);
}

/// The motor of a joint, or null.
inline const Motor* motor_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> const Motor* {
        if constexpr (requires { j.motor; }) return j.motor ? &*j.motor : nullptr;
        return nullptr;
      },
      joint);
}

/// The drive of a joint, or null.
inline const Drive* drive_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> const Drive* {
        if constexpr (requires { j.drive; }) return j.drive ? &*j.drive : nullptr;
        return nullptr;
      },
      joint);
}

/// The spring of a joint's coordinate, or null.
inline const Spring* spring_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> const Spring* {
        if constexpr (requires { j.spring; }) return j.spring ? &*j.spring : nullptr;
        return nullptr;
      },
      joint);
}

/// The largest torque or force of a joint's dry friction [N m or N], or nothing.
inline std::optional<double> friction_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<double> {
        if constexpr (requires { j.friction; }) return j.friction;
        return std::nullopt;
      },
      joint);
}

/// The armature of a joint's coordinate: a (dx/dt)^2/2 is part of the kinetic energy, as of the
/// rotor of a geared motor; 0 without one [kg m^2 or kg].
inline double armature_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) {
        if constexpr (requires { j.armature; }) return j.armature.value_or(0.0);
        return 0.0;
      },
      joint);
}

/// The drive of a hinge's angle, or null.
inline const AngularDrive* angular_drive_of(const Joint& joint) {
  const auto* hinge = std::get_if<HingeJoint>(&joint);
  return hinge != nullptr && hinge->drive ? &*hinge->drive : nullptr;
}

/// The spring of a hinge's angle, or null.
inline const AngularSpring* angular_spring_of(const Joint& joint) {
  const auto* hinge = std::get_if<HingeJoint>(&joint);
  return hinge != nullptr && hinge->spring ? &*hinge->spring : nullptr;
}

/// The limit of a hinge's angle, or null.
inline const AngleLimit* angle_limit_of(const Joint& joint) {
  const auto* hinge = std::get_if<HingeJoint>(&joint);
  return hinge != nullptr && hinge->limit ? &*hinge->limit : nullptr;
}

}  // namespace substep
