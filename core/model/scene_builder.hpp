#pragma once

#include <memory>
#include <string>

#include "core/model/scene.hpp"

namespace substep {

/// Makes a scene in code, and fills in what follows from the rest of it: moments of inertia from
/// shapes and masses, effects from the content, anchors and axes of joints from a place in the
/// world, names. Everything else is reached through scene().
///
/// Nothing is checked on the way: a Simulator refuses what is invalid, and validate() tells all
/// that is wrong.
class SceneBuilder {
 public:
  /// @param name identifier of the scene: a-z, 0-9, _ and -
  explicit SceneBuilder(std::string name = "scene");

  /// A moving body. @param mass [kg] @param position of its centre, world [m] @return its index
  int add_body(const Shape& shape, double mass, const Vec3& position);
  /// A body that never moves. @return its index
  int add_fixed(const Shape& shape, const Vec3& position);
  /// Keeps a point of a and a point of b together. @param b a body, or kWorld
  /// @param point where they are now, world [m] @return index of the joint
  int add_ball_joint(int a, int b, const Vec3& point);
  /// The same, and a turns against b about an axis only. @param axis world, of any length [-]
  int add_hinge(int a, int b, const Vec3& point, const Vec3& axis);
  /// A point of a slides along an axis of b, and neither turns against the other.
  int add_prismatic(int a, int b, const Vec3& point, const Vec3& axis);

  /// Of an index that was returned; orientation and position are to be set before joints are added.
  Body& body(int index) { return scene_.bodies[static_cast<std::size_t>(index)]; }
  JointBase& joint(int index) { return base(scene_.joints[static_cast<std::size_t>(index)]); }
  /// Gravity, frame, settings and the rest.
  Scene& scene() { return scene_; }

  /// The scene as it stands. Moments of inertia that are still 0 are those of a solid of the same
  /// shape and mass; effects are those that the content calls for.
  [[nodiscard]] std::shared_ptr<const Scene> build() const;

 private:
  int add(Body body);
  int add(Joint joint);

  Scene scene_;
};

}  // namespace substep
