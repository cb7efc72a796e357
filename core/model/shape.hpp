#pragma once

#include <variant>

#include "core/math/types.hpp"

namespace substep {

/// Centred at the body's centre of mass.
struct Sphere {
  double radius = 0.5;  // [m]
};

/// Centred at the body's centre of mass, edges along the body's axes.
struct Box {
  Vec3 half_extents{0.5, 0.5, 0.5};  // [m]
};

/// A half-space below the body's local y = 0, normal along the body's +y. Static bodies only.
struct Plane {};

using Shape = std::variant<Sphere, Box, Plane>;

/// Of the sphere around a shape [m]. A plane has none: 0.
double radius_around(const Shape& shape);

/// Principal moments of a solid shape about its centre [kg m^2], in the body's axes. A plane has
/// none.
Vec3 solid_inertia(const Shape& shape, double mass);

}  // namespace substep
