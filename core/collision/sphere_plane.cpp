#include "core/collision/shape_pairs.hpp"

namespace substep {

void touch(const Placed& a, const Sphere& sphere, const Placed& b, const Plane&, double margin,
           ContactPoints& out) {
  const Vec3 n = b.R.col(1);
  const Vec3 centre = a.x - b.x;
  const double distance = n.dot(centre);
  const double gap = distance - sphere.radius;
  if (gap > margin) return;
  add_point(a, b, 0, n, gap, -sphere.radius * n, centre - distance * n, out);
}

}  // namespace substep
