#pragma once

#include <Eigen/LU>

#include "core/model/scene.hpp"

namespace substep::test {

/// M of two rods of 1 m in a row, of 1 and 2 kg, on hinges with armatures of 0.2 and 0.5 kg m^2, in
/// the angle of the first and the angle between them [kg m^2].
/// @param scene its first two bodies are the rods
inline Eigen::Matrix2d inertia_of_two_rods(const Scene& scene) {
  const double I_1 = scene.bodies[0].inertia.z();
  const double I_2 = scene.bodies[1].inertia.z();
  Eigen::Matrix2d M;
  M << I_1 + 0.25 + I_2 + 2.0 * 2.25, I_2 + 2.0 * 0.75, I_2 + 2.0 * 0.75, I_2 + 2.0 * 0.25;
  M(0, 0) += 0.2;
  M(1, 1) += 0.5;
  return M;
}

}  // namespace substep::test
