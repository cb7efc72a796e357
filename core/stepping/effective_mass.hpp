#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Mt^-1 = M^-1 of every body of the part, world axes.
void inverse_mass(const Scene& scene, const Part& part, std::span<const Mat3> R_WB,
                  std::span<InverseMass> out);

/// Whether a mode puts another mass in the place of M.
bool changes_mass(Mode mode);

/// Puts Mt in the place of M, on the rotations of the bodies that are too stiff for dt by the
/// measure of the mode, and u* = Mt^-1 (beta Mt u + (1 - beta) M u + dt f) in the place of
/// M^-1 (M u + dt f). What a mode keeps of the velocity, beta, is what tells damping (0) from
/// geometric inertia (1).
/// @param state with k (and K of mode stiffness) of the last sub-step; u as M makes it, replaced
/// @param u_start velocities at the start of the sub-step  @param dt [s]
/// @param out Mt^-1
void effective_mass(const Scene& scene, const Part& part, const Settings& settings,
                    std::span<const Mat3> R_WB, std::span<const Vec6> u_start, double dt,
                    State& state, std::span<InverseMass> out);

}  // namespace substep
