#pragma once

#include <limits>
#include <variant>

#include "core/math/types.hpp"

namespace substep {

// Members of a shape: radius of the enclosing sphere about its centre [m]; smallest half width [m];
// half extents of its bounding box under the rotation R [m]; principal moments as a solid of a
// given mass [kg m^2]. Planes are infinite and have none of these.

/// Centred at the body's centre of mass.
struct Sphere {
  double radius = 0.5;  // [m]

  [[nodiscard]] double radius_around() const { return radius; }
  [[nodiscard]] double half_width() const { return radius; }
  [[nodiscard]] Vec3 bounds(const Mat3&) const { return Vec3::Constant(radius); }
  [[nodiscard]] Vec3 inertia(double mass) const {
    return Vec3::Constant(0.4 * mass * radius * radius);
  }
};

/// Centred at the body's centre of mass, edges along the body's axes.
struct Box {
  Vec3 half_extents{0.5, 0.5, 0.5};  // [m]

  [[nodiscard]] double radius_around() const { return half_extents.norm(); }
  [[nodiscard]] double half_width() const { return half_extents.minCoeff(); }
  [[nodiscard]] Vec3 bounds(const Mat3& R) const { return R.cwiseAbs() * half_extents; }
  [[nodiscard]] Vec3 inertia(double mass) const {
    // m/12 (b^2 + c^2) with full extents is m/3 (b^2 + c^2) with half extents.
    const Vec3 e = half_extents.cwiseProduct(half_extents);
    return mass / 3.0 * Vec3{e.y() + e.z(), e.x() + e.z(), e.x() + e.y()};
  }
};

/// A half-space below the body's local y = 0, normal along the body's +y. Static bodies only.
struct Plane {
  [[nodiscard]] static double radius_around() { return 0.0; }
  [[nodiscard]] static double half_width() { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] static Vec3 bounds(const Mat3&) { return Vec3::Zero(); }
  [[nodiscard]] static Vec3 inertia(double) { return Vec3::Zero(); }
};

using Shape = std::variant<Sphere, Box, Plane>;

/// Radius of the enclosing sphere of a shape [m]; 0 for a plane.
inline double radius_around(const Shape& shape) {
  return std::visit([](const auto& s) { return s.radius_around(); }, shape);
}

/// Half of the smallest width of a shape [m].
inline double half_width(const Shape& shape) {
  return std::visit([](const auto& s) { return s.half_width(); }, shape);
}

/// Principal moments of a solid shape about its centre [kg m^2], in the body's axes. Zero
/// for planes.
inline Vec3 solid_inertia(const Shape& shape, double mass) {
  return std::visit([mass](const auto& s) { return s.inertia(mass); }, shape);
}

}  // namespace substep
