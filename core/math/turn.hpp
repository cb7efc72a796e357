#pragma once
// Turns by their Cayley vectors c = tan(angle/2) axis: what a sub-step of integrate() turns a body
// by, c = dt omega/2. The quaternion is (1, c), normalised.

#include "core/math/types.hpp"

namespace substep {

/// v turned: R v with R = E + 2 ([c] + [c]^2)/(1 + c.c).
inline Vec3 turn(const Vec3& c, const Vec3& v) {
  const Vec3 w = c.cross(v);
  return v + (2.0 / (1.0 + c.squaredNorm())) * (w + c.cross(w));
}

/// The turn c followed by the turn d, world axes: (1, d) (1, c) = (1 - d.c, c + d + d x c).
inline Vec3 turn_after(const Vec3& c, const Vec3& d) {
  return (c + d + d.cross(c)) / (1.0 - d.dot(c));
}

}  // namespace substep
