#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/collision/shape_pairs.hpp"

namespace substep {

namespace {

/// A corner of the clipped incident face, in the frame of the reference box. Its persistent id is
/// the two lines that meet in it: 0..3 edges of the incident face, 4..7 sides of the reference.
struct Corner {
  Vec3 p = Vec3::Zero();
  unsigned in = 0;   // incoming line along the polygon
  unsigned out = 0;  // outgoing line
};

/// A quadrilateral clipped by four half-planes has at most eight corners.
struct Polygon {
  std::array<Corner, 8> corners;
  std::size_t size = 0;
  void add(const Corner& corner) {
    if (size < corners.size()) corners[size++] = corner;
  }
};

/// Clips to sign * p[axis] <= limit (Sutherland and Hodgman). Points on the limit, within rounding,
/// are kept and are not crossings: flush faces have four corners regardless of rounding.
/// @param on rounding [m]
Polygon clip(const Polygon& in, int axis, double sign, double limit, unsigned side, double on) {
  Polygon out;
  for (std::size_t i = 0; i < in.size; ++i) {
    const Corner& from = in.corners[i];
    const Corner& to = in.corners[(i + 1) % in.size];
    const double d_from = sign * from.p[axis] - limit;
    const double d_to = sign * to.p[axis] - limit;
    if (d_from <= on) out.add(from);
    const bool leaves = d_from < -on && d_to > on;
    const bool enters = d_from > on && d_to < -on;
    if (leaves || enters) {
      const double t = d_from / (d_from - d_to);
      const Vec3 p = from.p + t * (to.p - from.p);
      out.add(leaves ? Corner{p, from.out, side} : Corner{p, side, from.out});
    }
  }
  return out;
}

/// The face of box r with the largest gap to box i: axis, sign and gap.
struct Face {
  int axis = 0;
  double sign = 1.0;
  double gap = -std::numeric_limits<double>::infinity();
};

Face best_face(const Vec3& centre_R, const Mat3& R_RI, const Vec3& half_r, const Vec3& half_i) {
  Face best;
  for (int axis = 0; axis < 3; ++axis) {
    const double sign = centre_R[axis] < 0.0 ? -1.0 : 1.0;
    const double reach = std::abs(R_RI(axis, 0)) * half_i[0] + std::abs(R_RI(axis, 1)) * half_i[1] +
                         std::abs(R_RI(axis, 2)) * half_i[2];
    const double gap = std::abs(centre_R[axis]) - half_r[axis] - reach;
    if (gap > best.gap) best = {axis, sign, gap};
  }
  return best;
}

/// Contact points of the incident box i (body a) on the reference face of box r (body b).
void face_points(const Placed& i, const Vec3& half_i, const Placed& r, const Vec3& half_r,
                 const Face& face, double margin, ContactPoints& out) {
  const Mat3 R_RI = r.R.transpose() * i.R;
  const Vec3 centre_R = r.R.transpose() * (i.x - r.x);

  // The incident face is the most anti-parallel to the reference normal.
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(R_RI(face.axis, k)) > std::abs(R_RI(face.axis, axis))) axis = k;
  }
  const double sign = face.sign * R_RI(face.axis, axis) > 0.0 ? -1.0 : 1.0;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Polygon polygon;
  for (unsigned c = 0; c < 4; ++c) {
    Vec3 p_I;
    p_I[axis] = sign * half_i[axis];
    p_I[u] = (c == 0 || c == 3) ? -half_i[u] : half_i[u];
    p_I[v] = c < 2 ? -half_i[v] : half_i[v];
    polygon.add({centre_R + R_RI * p_I, (c + 3) % 4, c});
  }
  const int s = (face.axis + 1) % 3;
  const int t = (face.axis + 2) % 3;
  const double on = 1e-9 * (half_r.maxCoeff() + half_i.maxCoeff());
  polygon = clip(polygon, s, 1.0, half_r[s], 4, on);
  polygon = clip(polygon, s, -1.0, half_r[s], 5, on);
  polygon = clip(polygon, t, 1.0, half_r[t], 6, on);
  polygon = clip(polygon, t, -1.0, half_r[t], 7, on);

  const Vec3 n = face.sign * r.R.col(face.axis);
  const unsigned faces = static_cast<unsigned>(face.axis) * 24U + static_cast<unsigned>(axis) * 4U +
                         (face.sign > 0.0 ? 2U : 0U) + (sign > 0.0 ? 1U : 0U);
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Corner& corner = polygon.corners[k];
    const double gap = face.sign * corner.p[face.axis] - half_r[face.axis];
    if (gap > margin) continue;
    const Vec3 arm = r.R * corner.p - (i.x - r.x);
    ContactPoint& point = add_point(i, r, faces * 64U + corner.in * 8U + corner.out, n, gap, arm,
                                    r.R * corner.p - gap * n, out);
    point.field_arm = arm;
  }
}

// Edge against edge: the nine separating axes that are not face normals.

// Sine of the tilt, 0.6 degrees, below which edges have no well-defined common perpendicular and
// faces are flush.
constexpr double kTilt = 1e-2;

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

/// The pair of edges whose common perpendicular separates two boxes best.
struct EdgePair {
  int axis_a = 0;          // axis of the edge of a
  int axis_b = 0;          // axis of the edge of b
  Vec3 n = Vec3::UnitY();  // unit, perpendicular to both edges, from b to a, world
  double gap = -std::numeric_limits<double>::infinity();  // < 0 when overlapping [m]; -infinity if
                                                          // all edges are parallel
};

EdgePair best_edges(const Placed& a, const Vec3& half_a, const Placed& b, const Vec3& half_b) {
  EdgePair best;
  const Vec3 d = a.x - b.x;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = a.R.col(i).cross(b.R.col(j));
      const double sine_squared = across.squaredNorm();
      if (sine_squared < kTilt * kTilt) continue;
      const double side = across.dot(d) < 0.0 ? -1.0 : 1.0;
      const Vec3 n = side / std::sqrt(sine_squared) * across;
      const double gap = n.dot(d) - reach(a.R, half_a, n) - reach(b.R, half_b, n);
      if (gap > best.gap) best = {i, j, n, gap};
    }
  }
  return best;
}

// The point of closest approach of the two edges; false if it is beyond an end: then a corner is
// nearer. The points are p_a = c_a + s A and p_b = c_b + t B, with w = c_a - c_b, and their
// connection is perpendicular to both edges:
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

/// Geometric mean of the largest and the smallest half extent [m].
double mean_extent(const Vec3& half) { return std::sqrt(half.maxCoeff() * half.minCoeff()); }

}  // namespace

BoxAxis separating_axis(const Placed& a, const Box& box_a, const Placed& b, const Box& box_b) {
  const Mat3 R_BA = b.R.transpose() * a.R;
  const Vec3 d = a.x - b.x;
  const Face on_b = best_face(b.R.transpose() * d, R_BA, box_b.half_extents, box_a.half_extents);
  const Face on_a =
      best_face(-(a.R.transpose() * d), R_BA.transpose(), box_a.half_extents, box_b.half_extents);
  const EdgePair edges = best_edges(a, box_a.half_extents, b, box_b.half_extents);
  if (edges.gap > std::max(on_a.gap, on_b.gap)) return {edges.n, edges.gap};
  if (on_a.gap > on_b.gap) return {-on_a.sign * a.R.col(on_a.axis), on_a.gap};
  return {on_b.sign * b.R.col(on_b.axis), on_b.gap};
}

void touch(const Placed& a, const Box& box_a, const Placed& b, const Box& box_b, double margin,
           ContactPoints& out) {
  const Mat3 R_BA = b.R.transpose() * a.R;
  const Vec3 d = a.x - b.x;
  const Face on_b = best_face(b.R.transpose() * d, R_BA, box_b.half_extents, box_a.half_extents);
  if (on_b.gap > margin) return;
  const Face on_a =
      best_face(-(a.R.transpose() * d), R_BA.transpose(), box_a.half_extents, box_b.half_extents);
  if (on_a.gap > margin) return;
  const EdgePair edges = best_edges(a, box_a.half_extents, b, box_b.half_extents);
  if (edges.gap > margin) return;
  // Prefer faces unless two edges are clearly better: alternating between one contact and four
  // shakes a stack, and faces in contact have crossing edges at nearly the same gap. The two gaps
  // differ by the tilt times a length; with the longest one, thin plates would be detected too
  // late.
  const double length = std::min(mean_extent(box_a.half_extents), mean_extent(box_b.half_extents));
  const auto touch_edges = [&] {
    return edge_point(edges, a, box_a.half_extents, b, box_b.half_extents, out);
  };
  if (edges.gap > std::max(on_a.gap, on_b.gap) + kTilt * length && touch_edges()) return;
  // Prefer b's face unless a's is clearly better, so that faces in contact do not alternate.
  constexpr double kPreference = 1e-3;  // of that length [-]
  const std::size_t known = out.size();
  if (on_a.gap > on_b.gap + kPreference * length) {
    face_points(b, box_b.half_extents, a, box_a.half_extents, on_a, margin, out);
  } else {
    face_points(a, box_a.half_extents, b, box_b.half_extents, on_b, margin, out);
  }
  // Shallow overlaps: the preferred faces may have no common point.
  const bool overlaps = edges.gap < 0.0 && edges.gap > std::max(on_a.gap, on_b.gap);
  if (overlaps && out.size() == known) touch_edges();
}

}  // namespace substep
