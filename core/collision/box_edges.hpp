#pragma once
// Edge against edge of two boxes: the nine of the fifteen separating axes that are no face's
// normal.

#include "core/collision/shape_pairs.hpp"

namespace substep {

/// The pair of edges whose common perpendicular separates two boxes best.
struct EdgePair {
  int axis_a = 0;          // that the edge of a runs along
  int axis_b = 0;          // that the edge of b runs along
  Vec3 n = Vec3::UnitY();  // unit, across both edges, from b to a, world
  double gap = 0.0;        // < 0 when overlapping [m]; -infinity where all edges are parallel
};

EdgePair best_edges(const Placed& a, const Vec3& half_a, const Placed& b, const Vec3& half_b);

/// The one point where the two edges pass each other.
/// @return false where they pass beyond an end: then a corner is nearer than the edges are
bool edge_point(const EdgePair& edges, const Placed& a, const Vec3& half_a, const Placed& b,
                const Vec3& half_b, ContactPoints& out);

}  // namespace substep
