#include "core/collision/shape_pairs.hpp"

namespace substep {

void touch(const Placed& a, const Box& box, const Placed& b, const Plane&, double margin,
           ContactPoints& out) {
  const Vec3 n = b.R.col(1);
  const Vec3 centre = a.x - b.x;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 r = a.R * box.corner(corner);
    const Vec3 p = centre + r;
    const double gap = n.dot(p);
    if (gap > margin) continue;
    add_point(a, b, corner, n, gap, r, p - gap * n, out).field_arm = r;
  }
}

}  // namespace substep
