#pragma once

#include <cmath>

#include "core/math/types.hpp"

namespace substep {

/// Two unit vectors across a unit axis, right-handed with it.
inline void across(const Vec3& axis, Vec3& v1, Vec3& v2) {
  const Vec3 helper = std::abs(axis.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitY();
  v1 = axis.cross(helper).normalized();
  v2 = axis.cross(v1);
}

}  // namespace substep
