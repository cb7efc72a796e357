#pragma once

#include <span>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

// Eq. 9 looks at the geometric stiffness alone, and a top that spins freely has none: by it a body
// that turns by a radian a sub-step takes one. The rotation criterion puts two rates beside r, both
// bounded by the same Eq. 10, dt <= 2 sqrt(alpha/r):
//   the turn itself, r = (kTurnShare |omega|)^2, so that a sub-step turns a body by no more than
//   2 sqrt(alpha)/kTurnShare (0.2 rad at alpha = 0.1, up to which torques are predicted);
//   the gyroscopic rate of Euler's equations linearised about omega,
//   rate^2 = sum_i omega_i^2 |(I_i - I_j)(I_i - I_k)|/(I_j I_k), at which a disturbance of the axis
//   swings (or grows), at most |omega| for the moments of any solid.

inline constexpr double kTurnShare = 3.2;

/// The body of a part that spins fastest by this measure.
struct RotationBound {
  double r = 0.0;  // [1/s^2]
  int body = -1;   // -1 where nothing turns
};

/// Of bodies whose turn bends something: on joints, or with moments of inertia that differ.
class RotationCriterion {
 public:
  explicit RotationCriterion(const Scene& scene);
  /// @param u per body of the scene [m/s, rad/s]  @param q_WB of the same
  [[nodiscard]] RotationBound bound(const Scene& scene, std::span<const int> bodies,
                                    std::span<const Vec6> u, std::span<const Quat> q_WB) const;

 private:
  std::vector<std::uint8_t> counts_;  // per body
};

}  // namespace substep
