#pragma once

#include <span>

#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// M^-1 of a body about its principal axes; of a static one zero.
struct InertiaInverse {
  double linear = 0.0;          // 1/m [1/kg]
  Vec3 angular = Vec3::Zero();  // 1/I [1/(kg m^2)]
  bool isotropic = true;        // the same about every axis
};
std::vector<InertiaInverse> inertia_inverses(const Scene& scene);

/// Mt^-1 = M^-1 of the bodies of the part that move, world axes. @param own of all bodies
void inverse_mass(std::span<const InertiaInverse> own, const Part& part, std::span<const Mat3> R_WB,
                  std::span<InverseMass> out);

/// Whether a mode puts another mass in the place of M.
bool changes_mass(Mode mode);

/// Whether Mt of a body is another than M in a sub-step. @param state as effective_mass() reads it
bool changes_mass_of(std::size_t body, const Scene& scene, const Settings& settings,
                     const State& state, double dt);

/// Puts Mt in the place of M, on the rotations of the bodies that are too stiff for dt by the
/// measure of the mode, and u* = Mt^-1 (beta Mt u + (1 - beta) M u + dt f) in the place of
/// M^-1 (M u + dt f). The share of the velocity that a mode keeps, beta, distinguishes damping (0)
/// from geometric inertia (1).
/// @param own of all bodies  @param state with k (and K of mode stiffness) of the last sub-step; u
/// as M makes it, replaced
/// @param u_start velocities at the start of the sub-step  @param dt [s]
/// @param out Mt^-1
void effective_mass(const Scene& scene, const Part& part, const Settings& settings,
                    std::span<const InertiaInverse> own, std::span<const Mat3> R_WB,
                    std::span<const Vec6> u_start, double dt, State& state,
                    std::span<InverseMass> out);

}  // namespace substep
