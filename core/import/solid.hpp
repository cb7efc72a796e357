#pragma once
// Mass properties of homogeneous solids at their own centre, in the frames of MJCF and URDF: long
// axes are along z.

#include <optional>
#include <span>
#include <string>

#include "core/import/mass_properties.hpp"

namespace substep {

struct Solid {
  enum class Kind { kSphere, kCapsule, kCylinder, kEllipsoid, kBox };
  Kind kind = Kind::kSphere;
  // Half extents along x, y, z. Of a sphere, a capsule and a cylinder x is the radius, and z half
  // of the straight part [m].
  Vec3 half = Vec3::Zero();
};

/// [m^3]
double volume(const Solid& solid);

/// Of a solid of that mass [kg].
MassProperties mass_properties(const Solid& solid, double mass);

/// The convex hull of points, of density 1 kg/m^3. Nothing if the points are in a plane or too
/// many: kMostHullPoints.
inline constexpr std::size_t kMostHullPoints = 2000;
std::optional<MassProperties> hull_properties(std::span<const Vec3> points);

}  // namespace substep
