#pragma once
// Members of joints beyond JointBase, by name, for reading, writing and checking.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/model/joint.hpp"

namespace substep {

/// Calls `field(key, axis)` for each unit vector and `field(key, number, range)` for each number.
template <class J, class Field>
void own_fields(J& joint, Field&& field) {
  std::remove_const_t<J>::own_fields(joint, field);
}

/// Names of the joint types in files, in the order of the Joint variant.
inline constexpr auto kJointTypes = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{std::string_view(std::variant_alternative_t<I, Joint>::kType)...};
}
(std::make_index_sequence<std::variant_size_v<Joint>>{});

/// A joint of a type of kJointTypes.
inline Joint make_joint(std::size_t type) {
  Joint joint;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((I == type ? (void)joint.emplace<I>() : (void)0), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Joint>>{});
  return joint;
}

/// The two axes that a joint keeps parallel, in the frames of its bodies.
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

/// Nothing for a joint without axes.
inline std::optional<JointAxes> axes_of(const Joint& joint) {
  return std::visit(
      [](const auto& j) -> std::optional<JointAxes> {
        if constexpr (requires { j.axis_a; }) return JointAxes{j.axis_a, j.axis_b, j.kSlides};
        return std::nullopt;
      },
      joint);
}

/// The error part of the vector between a joint's anchors: all of it, or for a sliding joint the
/// component perpendicular to the axis. @param apart from the anchor on b to that on a, world [m]
/// @param q_b orientation of b
inline Vec3 gap_of(const Joint& joint, const Vec3& apart, const Quat& q_b) {
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

}  // namespace substep
