#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/math/types.hpp"

namespace substep {

// The geometric stiffness of Tournier et al. 2015, "Stable constrained dynamics", as a mass: forces
// rotate with their body within a step, Mt = M - dt^2 K. K is unsymmetric and partly destabilising,
// and M - dt^2 K can be singular, so only the resisting part of K is used. With a resisting k,
// Mt = M + dt^2 k, so the limit of damping.cpp, 2 (M + Mt) - dt^2 k = 4 M + dt^2 k, is positive
// for every k.

/// The part of -K that resists rotation: its symmetric part without negative eigenvalues.
/// @param K rotations of one body, d torque/d angle [N m/rad]
inline Mat3 resisting(const Mat3& K) {
  const Mat3 symmetric = -0.5 * (K + K.transpose());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
  const Mat3& V = eigen.eigenvectors();
  Mat3 out = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    out += std::max(0.0, eigen.eigenvalues()[i]) * V.col(i) * V.col(i).transpose();
  }
  return out;
}

/// Mt of a body's rotations [kg m^2]. @param I its inertia [kg m^2]  @param K_resisting
/// resisting(K) [N m/rad]  @param dt [s]. All in one frame.
inline Mat3 fully_stiffened_mass(const Mat3& I, const Mat3& K_resisting, double dt) {
  return I + dt * dt * K_resisting;
}

}  // namespace substep
