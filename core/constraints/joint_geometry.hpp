#pragma once

#include "core/constraints/block.hpp"

namespace substep {

inline const Vec3 kOrigin = Vec3::Zero();
inline const Mat3 kUnturned = Mat3::Identity();

/// World pose of one side of a joint; refers to data that must outlive it. For kWorld: origin, no
/// rotation.
struct Side {
  const Vec3& x = kOrigin;    // centre of mass, world [m]
  const Mat3& R = kUnturned;  // R_WB
};

/// Joint data for a sub-step, in the frames of its bodies.
struct JointGeometry {
  Vec3 anchor_a = Vec3::Zero();  // [m]
  Vec3 anchor_b = Vec3::Zero();
  // Joints with an axis: u in the frame of a; v1, v2 perpendicular to it in the frame of b.
  // Fixed orientation: w perpendicular to it in the frame of a.
  Vec3 u = Vec3::Zero();
  Vec3 v1 = Vec3::Zero();
  Vec3 v2 = Vec3::Zero();
  Vec3 w = Vec3::Zero();
  double length = 0.0;  // of a distance joint [m]
  // Limited angle: the middle of its range and half of its width [rad]. Limited travel: its bound
  // in `middle` [m].
  double middle = 0.0;
  double half_range = 0.0;
};

/// Change of a body's pose since its rows were computed. Zero for the world and static bodies.
struct Motion {
  Vec3 dx = Vec3::Zero();     // displacement of the centre of mass, world [m]
  Mat3 R = Mat3::Identity();  // its rotation, world axes
};

/// A range of rows of a block.
struct RowRange {
  int first = 0;
  int count = kMaxRows;  // maximum number of rows

  [[nodiscard]] bool reaches(int begin, int end) const {
    return first < end && first + count > begin;
  }
};

}  // namespace substep
