#pragma once

#include "core/math/types.hpp"

namespace substep {

/// A position and an orientation: x = position + orientation * x_own.
struct Pose {
  Vec3 position = Vec3::Zero();         // [m]
  Quat orientation = Quat::Identity();  // unit [-]

  [[nodiscard]] Vec3 operator*(const Vec3& point) const { return position + orientation * point; }
  [[nodiscard]] Pose operator*(const Pose& inner) const {
    return {*this * inner.position, (orientation * inner.orientation).normalized()};
  }
  [[nodiscard]] Pose inverse() const {
    return {orientation.conjugate() * -position, orientation.conjugate()};
  }
};

/// Mass, centre and inertia of a solid in some frame.
struct MassProperties {
  double mass = 0.0;            // [kg]
  Vec3 centre = Vec3::Zero();   // of mass [m]
  Mat3 inertia = Mat3::Zero();  // about the centre, axes of the frame [kg m^2]

  /// The same solid seen from a frame in which its own frame has that pose.
  [[nodiscard]] MassProperties moved(const Pose& pose) const;
  /// Scales mass and inertia.
  [[nodiscard]] MassProperties scaled(double factor) const;
  /// Two solids as one.
  MassProperties& operator+=(const MassProperties& other);
};

/// Principal axes of a solid. A tensor that is diagonal keeps its axes; others get them in the
/// order of their moments, right-handed.
struct PrincipalAxes {
  Quat orientation;  // from the principal axes to the frame of the tensor
  Vec3 moments;      // [kg m^2]
};
PrincipalAxes principal_axes(const Mat3& inertia);

/// Half extents of the homogeneous box of that mass and these moments [m]. A plate or a rod, whose
/// box would be flat, gets a hundredth of its largest half extent instead.
Vec3 equivalent_box(double mass, const Vec3& moments);

}  // namespace substep
