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
  ContactPoint point;
  // Coincident centres: any normal is valid; use one fixed in b.
  point.n = distance > 0.0 ? Vec3(d / distance) : Vec3(b.R.col(1));
  point.gap = distance - sphere_a.radius - sphere_b.radius;
  point.a = a.body;
  point.b = b.body;
  point.id = contact_id(a.body, b.body, 0);
  point.point_a = -sphere_a.radius * point.n;
  point.point_b = sphere_b.radius * point.n;
  if (distance > 0.0) {
    point.H = (Mat3::Identity() - point.n * point.n.transpose()) / distance;
  }
  out.push_back(point);
}

}  // namespace substep
