#pragma once
// Rotations by their Cayley vectors c = tan(angle/2) axis; integrate() uses c = dt omega/2. The
// quaternion is (1, c), normalised.

#include "core/math/types.hpp"

namespace substep {

/// R = E + 2 ([c] + [c]^2)/(1 + c.c), [c]^2 = c c^T - (c.c) E.
inline Mat3 turn_matrix(const Vec3& c) {
  const Vec3 k = (2.0 / (1.0 + c.squaredNorm())) * c;
  const double xx = k.x() * c.x();
  const double yy = k.y() * c.y();
  const double zz = k.z() * c.z();
  const double xy = k.x() * c.y();
  const double xz = k.x() * c.z();
  const double yz = k.y() * c.z();
  Mat3 R;
  R << 1.0 - (yy + zz), xy - k.z(), xz + k.y(),  //
      xy + k.z(), 1.0 - (xx + zz), yz - k.x(),   //
      xz - k.y(), yz + k.x(), 1.0 - (xx + yy);
  return R;
}

/// tan(x)/x to the third order of x, |x| half the rotation angle: the factor on the length of the
/// Cayley vector. Clamped beyond one radian, where the expansion is invalid, to keep values finite.
inline double half_tangent_factor(const Vec3& half_turn) {
  const double square = half_turn.squaredNorm();
  return 1.0 + (square < 1.0 ? square : 1.0) / 3.0;
}

/// The rotation c followed by d, world axes: (1, d) (1, c) = (1 - d.c, c + d + d x c).
inline Vec3 turn_after(const Vec3& c, const Vec3& d) {
  return (c + d + d.cross(c)) / (1.0 - d.dot(c));
}

/// The shortest rotation from one direction to another, c = a x b/(1 + a.b) with the unit vectors a
/// and b; of opposite directions half a turn about an arbitrary axis across them. The error is of
/// rounding, but up to 1e-7 rad of nearly opposite directions. Eigen's FromTwoVectors decomposes a
/// matrix for these, which takes seconds to compile in each file.
/// @param from, to of any length above 0
inline Quat turn_between(const Vec3& from, const Vec3& to) {
  constexpr double kOpposite = 1e-15;
  const Vec3 a = from.normalized();
  const Vec3 b = to.normalized();
  const double one_and_cosine = 1.0 + a.dot(b);
  if (one_and_cosine < kOpposite) {
    const Vec3 axis = a.unitOrthogonal();
    return {0.0, axis.x(), axis.y(), axis.z()};
  }
  const Vec3 across = a.cross(b);
  return Quat(one_and_cosine, across.x(), across.y(), across.z()).normalized();
}

}  // namespace substep
