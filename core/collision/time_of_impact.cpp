#include "core/collision/time_of_impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/turn.hpp"

namespace substep {
namespace {

/// The axis that separates two shapes best, from b to a, and the gap along it: the distance, or a
/// lower bound of it that is positive unless they touch.
struct Separation {
  Vec3 n = Vec3::UnitY();
  double gap = 0.0;  // [m]
};

Separation separation(const Placed& a, const Shape& shape_a, const Placed& b, const Shape& shape_b,
                      ContactPoints& scratch) {
  const auto* box_a = std::get_if<Box>(&shape_a);
  const auto* box_b = std::get_if<Box>(&shape_b);
  if (box_a != nullptr && box_b != nullptr) {
    const BoxAxis axis = separating_axis(a, *box_a, b, *box_b);
    return {axis.n, axis.gap};
  }
  scratch.clear();
  touch_shapes(a, shape_a, b, shape_b, std::numeric_limits<double>::infinity(), scratch);
  const ContactPoint& nearest =
      *std::min_element(scratch.begin(), scratch.end(),
                        [](const ContactPoint& p, const ContactPoint& q) { return p.gap < q.gap; });
  // The axis points to the shape that was given first.
  return {nearest.a == a.body ? nearest.n : Vec3(-nearest.n), nearest.gap};
}

/// A point that may touch first, along an axis towards the other shape.
struct Tip {
  double reach = 0.0;  // from the centre [m]
  double speed = 0.0;  // by rotation [m/s]
};

/// The tips of a shape: the corners of a box, of a sphere the foremost point.
struct Tips {
  std::array<Tip, 8> of;
  std::size_t count = 1;
  double foremost = 0.0;   // largest reach [m]
  double curvature = 0.0;  // bound on the acceleration of a tip by rotation [m/s^2]
};

/// @param n unit, towards the other shape  @param time at `pose` [s]
Tips tips_along(const Vec3& n, const Travel& travel, const Waypoint& pose, double time) {
  Tips tips;
  const auto* box = std::get_if<Box>(&travel.shape);
  if (box == nullptr) return tips;  // no tip turns
  // integrate()'s rotation of angle 2 atan(time |w|/2) slows down.
  const Vec3 w = travel.w.tail<3>();
  const Vec3 omega = w / (1.0 + 0.25 * time * time * w.squaredNorm());
  const Vec3 reach = pose.R.transpose() * n;
  const Vec3 speed = pose.R.transpose() * n.cross(omega);  // n . (omega x r) = (n x omega) . r
  tips.count = 8;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 r = box->corner(corner);
    tips.of[corner] = {reach.dot(r), speed.dot(r)};
    tips.foremost = std::max(tips.foremost, tips.of[corner].reach);
  }
  tips.curvature = w.squaredNorm() * radius_around(travel.shape);
  return tips;
}

/// How long the gap along an axis certainly stays above a level. @param left gap above it [m]
/// @param speed of approach of the centres [m/s]
double time_to_close(double left, double speed, const Tips& a, const Tips& b) {
  const double curvature = a.curvature + b.curvature;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      // gap - time s - time^2/2 curvature
      const double s = speed + a.of[i].speed + b.of[j].speed;
      const double gap = left + (a.foremost - a.of[i].reach) + (b.foremost - b.of[j].reach);
      const double root = s + std::sqrt(s * s + 2.0 * curvature * gap);
      if (root > 0.0) least = std::min(least, 2.0 * gap / root);
    }
  }
  return least;
}

}  // namespace

Waypoint after(const Travel& travel, double time) {
  return {travel.body, travel.x + time * travel.w.head<3>(),
          turn_matrix(0.5 * time * travel.w.tail<3>()) * travel.R};
}

std::optional<double> time_of_impact(const Travel& a, const Travel& b, double dt, double level,
                                     double accuracy, ContactPoints& scratch, std::int64_t& steps) {
  constexpr int kMost = 100;  // of two shapes that graze each other
  const Vec3 approach = b.w.head<3>() - a.w.head<3>();
  double time = 0.0;
  for (int i = 0; i < kMost; ++i) {
    ++steps;
    const Waypoint on_a = after(a, time);
    const Waypoint on_b = after(b, time);
    const Separation apart = separation(on_a.placed(), a.shape, on_b.placed(), b.shape, scratch);
    if (apart.gap <= level + accuracy) break;
    time += time_to_close(apart.gap - level - 0.5 * accuracy, apart.n.dot(approach),
                          tips_along(-apart.n, a, on_a, time), tips_along(apart.n, b, on_b, time));
    if (!(time < dt)) return std::nullopt;
  }
  return time;
}

}  // namespace substep
