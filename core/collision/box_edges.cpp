#include "core/collision/box_edges.hpp"

#include <cmath>
#include <limits>

namespace substep {
namespace {

// Edges closer to parallel than this have no well-defined common perpendicular; the adjacent faces
// are used instead. Sine squared of 0.6 degrees.
constexpr double kParallel = 1e-4;

double reach(const Mat3& R, const Vec3& half, const Vec3& n) {
  return std::abs(R.col(0).dot(n)) * half[0] + std::abs(R.col(1).dot(n)) * half[1] +
         std::abs(R.col(2).dot(n)) * half[2];
}

/// The edge of a box along `axis` that is farthest in direction `n`.
struct Edge {
  Vec3 middle = Vec3::Zero();  // from the box's centre, world axes [m]
  unsigned index = 0;          // among the box's twelve edges
};

Edge farthest_edge(const Mat3& R, const Vec3& half, int axis, const Vec3& n) {
  Edge edge;
  edge.index = static_cast<unsigned>(axis) * 4U;
  for (int k = 1; k <= 2; ++k) {
    const int across = (axis + k) % 3;
    const bool positive = R.col(across).dot(n) > 0.0;
    edge.middle += (positive ? half[across] : -half[across]) * R.col(across);
    if (positive) edge.index += static_cast<unsigned>(k);
  }
  return edge;
}

}  // namespace

EdgePair best_edges(const Placed& a, const Vec3& half_a, const Placed& b, const Vec3& half_b) {
  EdgePair best;
  best.gap = -std::numeric_limits<double>::infinity();
  const Vec3 d = a.x - b.x;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = a.R.col(i).cross(b.R.col(j));
      const double sine_squared = across.squaredNorm();
      if (sine_squared < kParallel) continue;
      const double side = across.dot(d) < 0.0 ? -1.0 : 1.0;
      const Vec3 n = side / std::sqrt(sine_squared) * across;
      const double gap = n.dot(d) - reach(a.R, half_a, n) - reach(b.R, half_b, n);
      if (gap > best.gap) best = {i, j, n, gap};
    }
  }
  return best;
}

// The points are p_a = c_a + s A and p_b = c_b + t B, with w = c_a - c_b, and their connection is
// perpendicular to both edges:
//   (w + s A - t B) . A = 0,  (w + s A - t B) . B = 0.
// Since these are the nearest points, sliding along the edges has no first-order effect: the
// gradient of the gap is n at the arms of p_a and p_b, as for any other contact.
bool edge_point(const EdgePair& edges, const Placed& a, const Vec3& half_a, const Placed& b,
                const Vec3& half_b, ContactPoints& out) {
  const Edge edge_a = farthest_edge(a.R, half_a, edges.axis_a, -edges.n);
  const Edge edge_b = farthest_edge(b.R, half_b, edges.axis_b, edges.n);
  const Vec3 A = a.R.col(edges.axis_a);
  const Vec3 B = b.R.col(edges.axis_b);
  const Vec3 w = (a.x - b.x) + edge_a.middle - edge_b.middle;
  const double cosine = A.dot(B);
  const double s = (cosine * w.dot(B) - w.dot(A)) / (1.0 - cosine * cosine);
  const double t = w.dot(B) + cosine * s;
  if (std::abs(s) > half_a[edges.axis_a] || std::abs(t) > half_b[edges.axis_b]) return false;

  constexpr unsigned kFirstEdgePair = 1U << 14U;  // above all face features
  const Vec3 arm = edge_a.middle + s * A;
  ContactPoint& point = add_point(a, b, kFirstEdgePair + edge_a.index * 16U + edge_b.index, edges.n,
                                  edges.gap, arm, edge_b.middle + t * B, out);
  // The exact contact stiffness treats n as fixed in b, as on a face: the curvature of the distance
  // between two lines is unbounded as they meet, and is not described by a field fixed in b.
  point.field_arm = arm;
  return true;
}

}  // namespace substep
