#include <cmath>

#include "core/collision/shape_pairs.hpp"

namespace substep {

void touch(const Placed& a, const Sphere& sphere_a, const Placed& b, const Sphere& sphere_b,
           double margin, ContactPoints& out) {
  const Vec3 d = a.x - b.x;
  const double reach = sphere_a.radius + sphere_b.radius + margin;
  const double squared = d.squaredNorm();
  if (squared > reach * reach) return;
  const double distance = std::sqrt(squared);
  // Coincident centres: any normal is valid; use one fixed in b.
  const Vec3 n = distance > 0.0 ? Vec3(d / distance) : Vec3(b.R.col(1));
  ContactPoint& point = add_point(a, b, 0, n, distance - sphere_a.radius - sphere_b.radius,
                                  -sphere_a.radius * n, sphere_b.radius * n, out);
  if (distance > 0.0) point.H = (Mat3::Identity() - n * n.transpose()) / distance;
}

}  // namespace substep
