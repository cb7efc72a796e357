#pragma once
// Checks of one body or joint, from a file or from code.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/body.hpp"
#include "core/model/joint.hpp"
#include "core/model/place.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {

// The fault of one value, or nothing.
std::optional<std::string> motion_fault(const Shape& shape, bool is_static);  // a moving plane
std::optional<std::string> inertia_fault(const Vec3& inertia);  // moments of no rigid body
std::optional<std::string> orientation_fault(const Quat& q);    // length
std::optional<std::string> axis_fault(const Vec3& axis);        // length
inline constexpr std::string_view kStaticMoves = "a static body never moves";

/// The members of a body that only a moving one has, besides mass and inertia.
struct MotionField {
  const char* key;
  Vec3 Body::*member;
  Range range;
};
inline constexpr MotionField kMotionFields[] = {
    {"velocity", &Body::velocity, kVelocityRange},
    {"angular_velocity", &Body::angular_velocity, kAngularVelocityRange},
    {"force", &Body::force, kBodyForceRange},
    {"torque", &Body::torque, kBodyTorqueRange}};

/// The fault of an index of a body, or nothing. @param or_else what else is allowed
std::optional<std::string> body_fault(const std::vector<Body>& bodies, int body,
                                      std::string_view or_else = "");

/// A fault of one member of a joint.
struct JointFault {
  std::string_view key;
  std::string message;
};
/// The fault of the body references, "a" or "b". @param a, b indices into bodies, or kWorld; any
/// other number is a fault
std::optional<JointFault> side_fault(const std::vector<Body>& bodies, int a, int b);
/// The first fault of members that depend on each other: "across_a" or "across_b" if it is not
/// perpendicular to its axis, "limit" if its bounds or directions do not fit, "drive" if its
/// directions do not or it has neither stiffness nor damping.
std::optional<JointFault> joint_fault(const Joint& joint);

/// Adds all problems of one body. @param place of the body, such as "/bodies/3"
void check_body(const Body& body, const DataPlace& place, Problems& problems);

/// Adds all problems of one joint. @param place of the joint, such as "/joints/3"
void check_joint(const Joint& joint, const std::vector<Body>& bodies, const DataPlace& place,
                 Problems& problems);

}  // namespace substep
