#pragma once

#include "core/math/types.hpp"

namespace substep {

/// The part of -K that resists a rotation: its symmetric part without the negative eigenvalues.
/// K itself is unsymmetric and partly destabilising, and M - dt^2 K with it can be singular.
/// @param K rotations of one body, d torque/d angle [N m/rad]
Mat3 resisting(const Mat3& K);

}  // namespace substep
