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

}  // namespace substep
