#pragma once
// Predicts the cost of a frame before each of its sub-steps.

#include <cstddef>
#include <cstdint>

#include "core/model/budget.hpp"
#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Progress of a frame.
struct FrameProgress {
  int taken = 0;           // sub-steps
  int left = 1;            // sub-steps, including the next one
  std::int64_t flops = 0;  // spent in the solver so far
  std::size_t bodies = 0;  // moved by the next sub-step
  std::size_t blocks = 0;  // blocks of rows in it
};

/// Work of a sub-step outside the solver: moving bodies, building and reading rows [operations].
double work_beside_solver(const FrameProgress& at);

/// Estimated work of the whole frame [operations]: moving bodies, plus the direct solver at its
/// mean cost per sub-step so far. Sweeps are excluded: the solver counts their work exactly.
double forecast_work(const FrameProgress& at, const Settings& settings);

/// True if every sub-step costs the same, because the number of sweeps is fixed.
bool is_shared(const Settings& settings);

/// Limits of the next solve. Sweeps recur in every sub-step, so the remaining budget is shared
/// among them. A direct solve may use all of it.
SolveLimits limits_of_solve(const FrameProgress& at, const Settings& settings,
                            const Budget& budget);

}  // namespace substep
