#pragma once

#include "core/math/types.hpp"

namespace substep {

/// The part of -K that resists a rotation: its symmetric part without the negative eigenvalues. The
/// mode `stiffness` has it in the mass, Mt = M + dt^2 resisting(K): the geometric stiffness of
/// Tournier et al. 2015, "Stable constrained dynamics". K itself is unsymmetric and partly
/// destabilising, and M - dt^2 K with it can be singular. With the k that resists Mt = M + dt^2 k,
/// so the limit of stepping/damping.hpp, 2 (M + Mt) - dt^2 k = 4 M + dt^2 k, is positive for every
/// k.
/// @param K rotations of one body, d torque/d angle [N m/rad]
Mat3 resisting(const Mat3& K);

}  // namespace substep
