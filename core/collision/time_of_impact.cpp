#include "core/collision/time_of_impact.hpp"

#include <algorithm>
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

/// Largest speed of a point of a shape relative to its centre [m/s].
double spin_speed(const Travel& travel) {
  const bool is_round = std::holds_alternative<Sphere>(travel.shape);
  return is_round ? 0.0 : radius_around(travel.shape) * travel.w.tail<3>().norm();
}

}  // namespace

Waypoint after(const Travel& travel, double time) {
  return {travel.body, travel.x + time * travel.w.head<3>(),
          turn_matrix(0.5 * time * travel.w.tail<3>()) * travel.R};
}

std::optional<double> time_of_impact(const Travel& a, const Travel& b, double dt, double level,
                                     double accuracy, ContactPoints& scratch) {
  constexpr int kMost = 100;  // of two shapes that graze each other
  const Vec3 approach = b.w.head<3>() - a.w.head<3>();
  const double spin = spin_speed(a) + spin_speed(b);
  double time = 0.0;
  for (int i = 0; i < kMost; ++i) {
    const Waypoint on_a = after(a, time);
    const Waypoint on_b = after(b, time);
    const Separation apart = separation(on_a.placed(), a.shape, on_b.placed(), b.shape, scratch);
    if (apart.gap <= level + accuracy) return time;
    const double speed = apart.n.dot(approach) + spin;
    if (!(speed > 0.0)) return std::nullopt;
    time += (apart.gap - level - 0.5 * accuracy) / speed;
    if (!(time < dt)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace substep
