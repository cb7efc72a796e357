#pragma once

#include "core/constraints/block.hpp"

namespace substep {

inline const Vec3 kOrigin = Vec3::Zero();
inline const Mat3 kUnturned = Mat3::Identity();

/// World pose of one side of a joint, which has to outlive it. For kWorld: origin, no rotation.
struct Side {
  const Vec3& x = kOrigin;    // centre of mass, world [m]
  const Mat3& R = kUnturned;  // R_WB
};

/// What a sub-step reads of a joint, in the frames of its bodies.
struct JointGeometry {
  Vec3 anchor_a = Vec3::Zero();  // [m]
  Vec3 anchor_b = Vec3::Zero();
  // Of joints with an axis: u in the frame of a; v1, v2 across it, in the frame of b. Prismatic: w
  // across it in the frame of a.
  Vec3 u = Vec3::Zero();
  Vec3 v1 = Vec3::Zero();
  Vec3 v2 = Vec3::Zero();
  Vec3 w = Vec3::Zero();
};

/// How a body's pose has changed since its rows were made. The world and static bodies stay.
struct Motion {
  Vec3 dx = Vec3::Zero();     // way of the centre of mass, world [m]
  Mat3 R = Mat3::Identity();  // its rotation, world axes
};

/// Some rows of a block.
struct RowRange {
  int first = 0;
  int count = kMaxRows;  // at most

  [[nodiscard]] bool reaches(int begin, int end) const {
    return first < end && first + count > begin;
  }
};

}  // namespace substep
