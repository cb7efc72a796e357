#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "core/math/types.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The part of the window for the scene, in logical pixels from the top left corner. The picture
/// fills the window; its main content stays inside this rectangle.
struct ViewRect {
  float x = 0.0F;
  float y = 0.0F;
  float width = 1.0F;
  float height = 1.0F;
};

/// A bounding sphere.
struct Bounds {
  Vec3 centre = Vec3::Zero();
  double radius = 1.0;
};

/// Orbits a target point. Input sets a goal; the camera eases to it.
class OrbitCamera {
 public:
  static constexpr double kFieldOfView = 0.61;  // vertical, over the view rectangle [rad]

  /// Jumps to the scene's own camera.
  /// @param half_width to be visible on either side of the target, in any view [m]
  void place(const Camera& camera, double half_width);
  [[nodiscard]] static Vec3 right_of(const Camera& camera);
  /// Moves so that the sphere fills the view; keeps the viewing direction.
  void frame(const Bounds& bounds);
  /// Moves to the sphere like frame(), but keeps the shape of the required region.
  void turn_to(const Bounds& bounds);
  /// Moves back to where another one is heading.
  void return_to(const OrbitCamera& other) { goal_ = other.goal_; }
  void orbit(double yaw, double pitch);                     ///< [rad]
  void pan(double right, double up, const ViewRect& view);  ///< by logical pixels
  void zoom(double factor);                                 ///< > 1 goes closer
  /// Shifts the whole view, with everything that was set. @param offset from it [m]
  void carry(const Vec3& offset) { carried_ = offset; }
  /// @param dt wall time [s]; @param jump arrives at once (reduced motion)
  void update(double dt, bool jump);

  /// Where it is heading: yaw, pitch, distance and target, "0.5,0.2,20,0,3,0".
  [[nodiscard]] std::string text() const;
  /// Jumps to such a place. @return false if the text is not one
  bool set(std::string_view text);

  [[nodiscard]] bool at_rest() const;
  /// Whether a person has moved it since place(): orbited, panned or zoomed.
  [[nodiscard]] bool by_hand() const { return by_hand_; }
  /// Number of calls of place().
  [[nodiscard]] int placed() const { return placed_; }
  [[nodiscard]] Vec3 eye(const ViewRect& view) const;
  /// Apparent size in a view, up to a common factor; used to compare views.
  [[nodiscard]] double magnification(const ViewRect& view) const;
  [[nodiscard]] Vec3 target() const { return now_.target + carried_; }
  /// World to clip space of the window, with the target at the centre of the view rectangle.
  [[nodiscard]] Eigen::Matrix4d view_projection(const ViewRect& view, double window_width,
                                                double window_height) const;

 private:
  struct Pose {
    Vec3 target = Vec3::Zero();
    double yaw = 0.0;    // about +y, 0 looks along -z [rad]
    double pitch = 0.2;  // above the horizon [rad]
    double distance = 20.0;
  };
  [[nodiscard]] static Vec3 backward(const Pose& pose);
  /// Factor on the distance, above 1 if the view is narrower than the required aspect.
  [[nodiscard]] double fit(const ViewRect& view) const;
  Pose now_;
  Pose goal_;
  Vec3 carried_ = Vec3::Zero();  // of both targets [m]
  double aspect_ = 1.0;          // width over height of the required region
  bool by_hand_ = false;
  int placed_ = 0;
};

}  // namespace substep
