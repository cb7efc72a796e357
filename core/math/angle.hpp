#pragma once
// Angles without library functions of libm, whose last bits differ between systems.

#include <cmath>
#include <numbers>

#include "core/math/types.hpp"

namespace substep {

/// The angle from -pi to pi whose sine and cosine have the ratio of s and c [rad]; 0 if both are 0.
inline double angle_of(double s, double c) {
  const double length = std::sqrt(s * s + c * c);
  if (!(length > 0.0)) return 0.0;
  double t = s / (length + std::abs(c));  // tangent of half the angle, at most 1
  for (int halved = 0; halved < 3; ++halved) t /= 1.0 + std::sqrt(1.0 + t * t);
  const double x = t * t;  // at most 0.0098
  double series = 0.0;     // t^15 / 15 is the last term
  for (int k = 15; k > 0; k -= 2) series = 1.0 / k - x * series;
  const double acute = 16.0 * t * series;
  if (c >= 0.0) return acute;
  return s < 0.0 ? -std::numbers::pi - acute : std::numbers::pi - acute;
}

/// The angle that differs from a given one by full turns, from -pi to pi. @param angle |angle| <
/// 1e3
inline double wrapped(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  while (angle > std::numbers::pi) angle -= kTurn;
  while (angle < -std::numbers::pi) angle += kTurn;
  return angle;
}

/// The rotation about an axis from one direction across it to another, from -pi to pi [rad].
inline double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
  return angle_of(axis.dot(from.cross(to)), from.dot(to));
}

}  // namespace substep
