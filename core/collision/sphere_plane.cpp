#include "core/collision/shape_pairs.hpp"

namespace substep {

void sphere_plane(const Placed& a, const Sphere& sphere, const Placed& b, double margin,
                  ContactPoints& out) {
  ContactPoint point;
  point.n = b.R.col(1);
  const Vec3 centre = a.x - b.x;
  const double distance = point.n.dot(centre);
  point.gap = distance - sphere.radius;
  if (point.gap > margin) return;
  point.a = a.body;
  point.b = b.body;
  point.id = contact_id(a.body, b.body, 0);
  point.point_a = -sphere.radius * point.n;
  point.point_b = centre - distance * point.n;
  out.push_back(point);
}

}  // namespace substep
