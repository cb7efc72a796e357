#pragma once

#include <span>
#include <vector>

#include "core/model/scene.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Mt^-1 = M^-1 of every body, world axes.
void inverse_mass(const Scene& scene, std::span<const Mat3> R_WB, std::vector<InverseMass>& out);

/// Adaptive damping (Eq. 6): Mt = M + dt B with b_i = max(0, (dt^2 k_i - 4 alpha M_ii)/dt) on the
/// angular degrees of freedom, in the principal frame. Also replaces u by Mt^-1 M u.
/// @param k diagonal of K per body (Eq. 4)  @param dt [s]
void damped_inverse_mass(const Scene& scene, std::span<const Mat3> R_WB, std::span<const Vec6> k,
                         double alpha, double dt, std::vector<InverseMass>& out, std::span<Vec6> u);

}  // namespace substep
