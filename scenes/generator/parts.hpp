#pragma once
// What several scenes are put together from.

#include <string>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// A moving body with the inertia of its solid shape, at rest.
Body solid(std::string name, const Shape& shape, double mass, const Vec3& position);

/// A box by its full extents [m].
Box box(double x, double y, double z);

/// A static plane y = height, facing up [m].
Body floor_plane(double height = 0.0);

/// The orientation that turns +x to (c, s, 0): a turn about z by an angle between -180 and 180 deg.
/// @param c its cosine  @param s its sine
Quat turn_about_z(double c, double s);

/// A body's local point in the world [m].
Vec3 world_point(const Body& body, const Vec3& local);

}  // namespace substep::scenes
