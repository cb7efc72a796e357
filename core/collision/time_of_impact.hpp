#pragma once

#include <cstdint>
#include <optional>

#include "core/collision/shape_pairs.hpp"

namespace substep {

/// A body on its way through a sub-step, as integrate() moves it.
struct Travel {
  int body;  // index into Scene::bodies
  const Shape& shape;
  const Vec3& x;  // at the start, world [m]
  const Mat3& R;  // R_WB at the start
  const Vec6& w;  // [m/s, rad/s]
};

/// A pose on the way.
struct Waypoint {
  int body;
  Vec3 x;
  Mat3 R;
  [[nodiscard]] Placed placed() const { return {body, x, R}; }
};
Waypoint after(const Travel& travel, double time);

/// When the gap of two bodies first is as small as `level`, by conservative advancement (Mirtich
/// 1996): it cannot be before a corner has closed the gap along the best separating axis at its own
/// speed and the largest acceleration of its rotation. Of shapes that graze each other the time is
/// one at which they are still apart.
/// @param dt the sub-step [s]  @param level < 0 for an overlap [m]
/// @param accuracy within which the level is reached [m]  @param scratch its contents are lost
/// @param steps increased by the number of poses tried
/// @return in [0, dt) [s], or nothing if they miss each other
std::optional<double> time_of_impact(const Travel& a, const Travel& b, double dt, double level,
                                     double accuracy, ContactPoints& scratch, std::int64_t& steps);

}  // namespace substep
