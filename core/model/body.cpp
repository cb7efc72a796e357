#include "core/model/body.hpp"

namespace substep {

Vec6 velocity_of(const Body& body) {
  Vec6 u;
  u << body.velocity, body.angular_velocity;
  return u;
}

double fastest_point(const Body& body, const Vec6& u) {
  return u.head<3>().norm() + radius_around(body.shape) * u.tail<3>().norm();
}

double fastest_gain(const Body& body) {
  if (body.is_static) return 0.0;
  constexpr double kMost = 1e9;  // [m/s^2]
  const double gain = body.force.norm() / body.mass +
                      radius_around(body.shape) * body.torque.norm() / body.inertia.minCoeff();
  return gain < kMost ? gain : kMost;  // NaN also becomes kMost
}

}  // namespace substep
