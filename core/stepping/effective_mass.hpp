#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// M^-1 of all bodies.
std::vector<InertiaInverse> inertia_inverses(const Scene& scene);

/// Sets Mt^-1 = M^-1 for the moving bodies of the part, world axes. @param own of all bodies
void inverse_mass(std::span<const InertiaInverse> own, const Part& part, std::span<const Mat3> R_WB,
                  std::span<InverseMass> out);

/// True if Mt of a body differs from M in a sub-step. @param state as for effective_mass()
bool changes_mass_of(std::size_t body, const Scene& scene, const Settings& settings,
                     const State& state, double dt);

/// Replaces M by Mt for rotations that the mode's criterion finds too stiff for dt, and
/// M^-1 (M u + dt f) by u* = Mt^-1 (beta Mt u + (1 - beta) M u + dt f). beta, the share of the
/// velocity term taken with Mt, is 0 for damping and 1 for geometric inertia.
/// @param own of all bodies  @param state with k (and K of mode stiffness) of the last sub-step; u
/// computed with M; overwritten
/// @param u_start velocities at the start of the sub-step  @param dt [s]
/// @param out Mt^-1
void effective_mass(const Scene& scene, const Part& part, const Settings& settings,
                    std::span<const InertiaInverse> own, std::span<const Mat3> R_WB,
                    std::span<const Vec6> u_start, double dt, State& state,
                    std::span<InverseMass> out);

}  // namespace substep
