#include <cmath>

#include "core/collision/shape_pairs.hpp"

namespace substep {

// Sphere and box are convex: one point. The distance field of the box at the centre is that of the
// nearest face, edge or corner: curved along axes in which the centre is outside the box, flat
// along the others.
void touch(const Placed& a, const Sphere& sphere, const Placed& b, const Box& box, double margin,
           ContactPoints& out) {
  const Vec3 c = b.R.transpose() * (a.x - b.x);  // centre in the box's frame
  const Vec3 nearest = c.cwiseMax(-box.half_extents).cwiseMin(box.half_extents);
  const Vec3 d = c - nearest;
  const double squared = d.squaredNorm();
  const double reach = sphere.radius + margin;
  if (squared > reach * reach) return;

  Vec3 n;
  Mat3 H = Mat3::Zero();
  Eigen::Index axis = 0;  // of the nearest face; unused at edges and corners
  int outside = 0;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0) continue;
    axis = i;
    ++outside;
  }
  Vec3 surface_B = nearest;
  double distance = 0.0;
  if (outside > 1) {  // an edge or a corner
    distance = std::sqrt(squared);
    const Vec3 n_B = d / distance;
    Mat3 H_B = -n_B * n_B.transpose() / distance;
    for (int i = 0; i < 3; ++i) {
      if (d[i] != 0.0) H_B(i, i) += 1.0 / distance;
    }
    n = b.R * n_B;
    H = b.R * H_B * b.R.transpose();
  } else {
    double side = d[axis] < 0.0 ? -1.0 : 1.0;
    distance = std::abs(d[axis]);
    if (outside == 0) {  // the centre is inside: push out through the nearest face
      const double depth = (box.half_extents - c.cwiseAbs()).minCoeff(&axis);
      side = c[axis] < 0.0 ? -1.0 : 1.0;
      surface_B[axis] = side * box.half_extents[axis];
      distance = -depth;
    }
    n = side * b.R.col(axis);
  }
  add_point(a, b, 0, n, distance - sphere.radius, -sphere.radius * n, b.R * surface_B, out).H = H;
}

}  // namespace substep
