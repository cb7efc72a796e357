#pragma once

#include <memory>
#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// Builds a scene in code and derives dependent values: moments of inertia from shapes and masses,
/// effects from the content, anchors and axes of joints from world coordinates, names. All else is
/// set through scene().
///
/// Numbers are not checked while building: a Simulator rejects invalid scenes, and validate()
/// returns all problems. An index of a body or a joint that is not there throws std::out_of_range,
/// but for the bodies of a new joint; a limit, drive, spring, friction or armature of a joint that
/// is no hinge and no slide throws std::invalid_argument.
class SceneBuilder {
 public:
  /// @param name identifier of the scene: a-z, 0-9, _ and -
  explicit SceneBuilder(std::string name = "scene");

  /// A moving body. @param mass [kg] @param position of its centre, world [m] @return its index
  int add_body(const Shape& shape, double mass, const Vec3& position);
  /// A body that never moves. @return its index
  int add_fixed(const Shape& shape, const Vec3& position);
  /// Keeps a point of a and a point of b together. @param b a body, or kWorld
  /// @param point common point in the current poses, world [m] @return index of the joint
  int add_ball_joint(int a, int b, const Vec3& point);
  /// A hinge: like a ball joint, but a rotates relative to b only about an axis. @param axis world,
  /// of any length [-]
  int add_hinge(int a, int b, const Vec3& point, const Vec3& axis);
  /// Bounds the angle of a hinge, 0 in the current poses, or the travel of a slide (prismatic or
  /// cylindrical) from its anchor
  /// on b. @param joint its index  @param lower, upper [rad or m]  @param restitution [-]
  void limit(int joint, double lower, double upper, double restitution = 0.0);
  /// Turns a hinge, or moves a slide. @param velocity of a relative to b [rad/s or m/s]
  /// @param effort the largest torque or force [N m or N]
  void drive(int joint, double velocity, double effort);
  /// Drives the angle of a hinge, 0 in the current poses, or the travel of a slide to a target.
  void drive(int joint, const Drive& by);
  /// A spring and damper of a hinge or a slide, whose coordinate is 0 here.
  void add_spring(int joint, const Spring& spring);
  /// Dry friction of a hinge or a slide. @param effort the largest torque or force [N m or N]
  void rub(int joint, double effort);
  /// Inertia of the angle of a hinge or the travel of a slide, besides that of the bodies.
  /// @param inertia [kg m^2 or kg]
  void add_armature(int joint, double inertia);
  /// A point of a slides along an axis of b, without relative rotation.
  int add_prismatic(int a, int b, const Vec3& point, const Vec3& axis);
  /// A weld at a point of the world: a keeps its position and orientation relative to b.
  int add_weld(int a, int b, const Vec3& point);
  /// Two bodies turn about crossing axes at a point: one in a, one in b, both in the world now. The
  /// second is made perpendicular to the first.
  int add_universal(int a, int b, const Vec3& point, const Vec3& axis_a, const Vec3& axis_b);
  /// A point of a slides along an axis of b, and a turns about it.
  int add_cylindrical(int a, int b, const Vec3& point, const Vec3& axis);
  /// A rope without mass from a point of b to a point of a, both in the world [m].
  /// @param length its length [m]  @param restitution of a that it stops [-]
  int add_rope(int a, int b, const Vec3& on_a, const Vec3& on_b, double length,
               double restitution = 0.0);
  /// A rod without mass from a point of b to a point of a, both in the world [m].
  int add_distance(int a, int b, const Vec3& on_a, const Vec3& on_b);

  /// A body or joint by its returned index. Set orientation and position before adding joints.
  Body& body(int index) { return scene_.bodies.at(static_cast<std::size_t>(index)); }
  JointBase& joint(int index) { return base(scene_.joints.at(static_cast<std::size_t>(index))); }
  /// Access to gravity, frame, settings and all else.
  Scene& scene() { return scene_; }

  /// The finished scene. Moments of inertia that are 0 are set to those of a solid of the same
  /// shape and mass; effects are those that the content requires.
  [[nodiscard]] std::shared_ptr<const Scene> build() const;

 private:
  int add(Body body);
  int add(Joint joint);
  /// World direction from which the angle of a hinge is measured, in the current poses.
  [[nodiscard]] AngleZero zero_of(const HingeJoint& hinge) const;

  Scene scene_;
};

}  // namespace substep
