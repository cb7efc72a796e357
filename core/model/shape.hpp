#pragma once

#include <limits>
#include <optional>
#include <variant>

#include "core/math/types.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {

/// A box with rounded edges, about the body's centre along its axes; if the radius of the edges
/// equals all half extents, a ball.
struct RoundedBox {
  Vec3 half_extents;      // [m]
  double rounding = 0.0;  // radius of the edges [m]
  [[nodiscard]] bool is_ball() const { return (half_extents.array() == rounding).all(); }
};

// Each shape has kType, its name in files; kMoves; and own_fields(), which lists its data for
// reading, writing and checking: field(key, member, range, factor); files hold factor times the
// member.
// Members: radius of the enclosing sphere about its centre [m]; smallest half width [m];
// half extents of its bounding box under the rotation R [m]; principal moments as a solid of a
// given mass [kg m^2]; the rounded box that stands for it in pictures. Planes are infinite and have
// none of these.

/// Centred at the body's centre of mass.
struct Sphere {
  static constexpr const char* kType = "sphere";
  static constexpr bool kMoves = true;
  double radius = 0.5;  // [m]

  template <class S, class Field>
  static void own_fields(S& sphere, Field&& field) {
    field("radius", sphere.radius, kSizeRange, 1.0);
  }
  [[nodiscard]] double radius_around() const { return radius; }
  [[nodiscard]] double half_width() const { return radius; }
  [[nodiscard]] Vec3 bounds(const Mat3&) const { return Vec3::Constant(radius); }
  [[nodiscard]] Vec3 inertia(double mass) const {
    return Vec3::Constant(0.4 * mass * radius * radius);
  }
  [[nodiscard]] RoundedBox outline() const { return {Vec3::Constant(radius), radius}; }
};

/// Centred at the body's centre of mass, edges along the body's axes.
struct Box {
  static constexpr const char* kType = "box";
  static constexpr bool kMoves = true;
  Vec3 half_extents{0.5, 0.5, 0.5};  // [m]

  template <class S, class Field>
  static void own_fields(S& box, Field&& field) {
    field("size", box.half_extents, kSizeRange, 2.0);
  }
  /// @param i below 8; its bits are the signs of x, y and z, 1 for positive
  [[nodiscard]] Vec3 corner(unsigned i) const {
    return {(i & 1U) != 0U ? half_extents.x() : -half_extents.x(),
            (i & 2U) != 0U ? half_extents.y() : -half_extents.y(),
            (i & 4U) != 0U ? half_extents.z() : -half_extents.z()};
  }
  [[nodiscard]] double radius_around() const { return half_extents.norm(); }
  [[nodiscard]] double half_width() const { return half_extents.minCoeff(); }
  [[nodiscard]] Vec3 bounds(const Mat3& R) const { return R.cwiseAbs() * half_extents; }
  [[nodiscard]] Vec3 inertia(double mass) const {
    // m/12 (b^2 + c^2) with full extents is m/3 (b^2 + c^2) with half extents.
    const Vec3 e = half_extents.cwiseProduct(half_extents);
    return mass / 3.0 * Vec3{e.y() + e.z(), e.x() + e.z(), e.x() + e.y()};
  }
  [[nodiscard]] RoundedBox outline() const { return {half_extents}; }
};

/// A half-space below the body's local y = 0, normal along the body's +y. Static bodies only.
struct Plane {
  static constexpr const char* kType = "plane";
  static constexpr bool kMoves = false;

  template <class S, class Field>
  static void own_fields(S&, Field&&) {}
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

/// Nothing for a plane.
inline std::optional<RoundedBox> outline(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> std::optional<RoundedBox> {
        if constexpr (requires { s.outline(); }) return s.outline();
        return std::nullopt;
      },
      shape);
}

/// Principal moments of a solid shape about its centre [kg m^2], in the body's axes. Zero
/// for planes.
inline Vec3 solid_inertia(const Shape& shape, double mass) {
  return std::visit([mass](const auto& s) { return s.inertia(mass); }, shape);
}

}  // namespace substep
