#include "core/collision/shape_pairs.hpp"

namespace substep {

void touch(const Placed& a, const Sphere& sphere, const Placed& b, const Plane&, double margin,
           ContactPoints& out) {
  const Vec3 n = b.R.col(1);
  const Vec3 centre = a.x - b.x;
  const double distance = n.dot(centre);
  const double gap = distance - sphere.radius;
  if (gap > margin) return;
  ContactPoint& point = out.emplace_back();
  point.a = a.body;
  point.b = b.body;
  point.id = contact_id(a.body, b.body, 0);
  point.n = n;
  point.gap = gap;
  point.point_a = -sphere.radius * n;
  point.point_b = centre - distance * n;
}

}  // namespace substep
