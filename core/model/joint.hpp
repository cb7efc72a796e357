#pragma once

#include <string>
#include <variant>

#include "core/math/types.hpp"

namespace substep {

inline constexpr int kWorld = -1;  ///< as a joint's body b: fixed in the world

/// What every joint has. Body a moves; body b may be moving, static, or kWorld.
struct JointBase {
  std::string name;
  int a = 0;                     // index into Scene::bodies
  int b = kWorld;                // index into Scene::bodies, or kWorld
  Vec3 anchor_a = Vec3::Zero();  // in the frame of a [m]
  Vec3 anchor_b = Vec3::Zero();  // in the frame of b, or in the world for kWorld [m]
  double compliance = 0.0;       // C of the three positional rows [m/N], >= 0
};

/// The two anchors coincide: 3 rows.
struct BallJoint : JointBase {
  static constexpr const char* kType = "ball";  // in files
};

/// The two anchors coincide and the two axes stay parallel: 5 rows.
struct HingeJoint : JointBase {
  static constexpr const char* kType = "hinge";
  Vec3 axis_a = Vec3::UnitZ();      // unit, in the frame of a [-]
  Vec3 axis_b = Vec3::UnitZ();      // unit, in the frame of b, or in the world for kWorld [-]
  double angular_compliance = 0.0;  // C of the two angular rows [rad/(N m)], >= 0
};

using Joint = std::variant<BallJoint, HingeJoint>;

inline const JointBase& base(const Joint& joint) {
  return std::visit([](const auto& j) -> const JointBase& { return j; }, joint);
}
inline JointBase& base(Joint& joint) {
  return std::visit([](auto& j) -> JointBase& { return j; }, joint);
}

}  // namespace substep
