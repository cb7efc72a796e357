#pragma once

#include "core/constraints/fixed_axes.hpp"
#include "core/constraints/sliding_rows.hpp"

namespace substep {

/// A prismatic joint: rows 0, 1 of SlidingRows leave the anchor on a free only along the axis; rows
/// 2..4 prevent relative rotation.
struct PrismaticRows : SlidingRows<FixedAxes<2>> {};

}  // namespace substep
