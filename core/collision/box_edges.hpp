#pragma once
// Edge against edge of two boxes: the nine separating axes that are not face normals.

#include "core/collision/shape_pairs.hpp"

namespace substep {

/// The pair of edges whose common perpendicular separates two boxes best.
struct EdgePair {
  int axis_a = 0;          // axis of the edge of a
  int axis_b = 0;          // axis of the edge of b
  Vec3 n = Vec3::UnitY();  // unit, perpendicular to both edges, from b to a, world
  double gap = 0.0;        // < 0 when overlapping [m]; -infinity if all edges are parallel
};

EdgePair best_edges(const Placed& a, const Vec3& half_a, const Placed& b, const Vec3& half_b);

/// The point of closest approach of the two edges. @return false if it is beyond an end: then a
/// corner is nearer
bool edge_point(const EdgePair& edges, const Placed& a, const Vec3& half_a, const Placed& b,
                const Vec3& half_b, ContactPoints& out);

}  // namespace substep
