#include "core/model/shape.hpp"

namespace substep {

double radius_around(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* box = std::get_if<Box>(&shape)) return box->half_extents.norm();
  return 0.0;
}

Vec3 solid_inertia(const Shape& shape, double mass) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return Vec3::Constant(0.4 * mass * sphere->radius * sphere->radius);
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    // m/12 (b^2 + c^2) with full extents is m/3 (b^2 + c^2) with half extents.
    const Vec3 e = box->half_extents.cwiseProduct(box->half_extents);
    return mass / 3.0 * Vec3{e.y() + e.z(), e.x() + e.z(), e.x() + e.y()};
  }
  return Vec3::Zero();
}

}  // namespace substep
