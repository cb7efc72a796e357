#pragma once
// Predicts what a frame will take, before each of its sub-steps.

#include <cstddef>
#include <cstdint>

#include "core/model/budget.hpp"
#include "core/model/settings.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Where a frame stands.
struct FrameProgress {
  int taken = 0;           // sub-steps
  int left = 1;            // sub-steps, the one to come included
  std::int64_t flops = 0;  // of the solver, so far
  std::size_t bodies = 0;  // that the one to come moves
  std::size_t blocks = 0;  // of rows, in it
};

/// What a sub-step takes beside the solver: bodies that move, rows that are made and read
/// [operations].
double work_beside_solver(const FrameProgress& at);

/// The work of the whole frame, as far as it is known before the next sub-step: of bodies that
/// move, and of the direct solver as much in each sub-step as in the mean of those taken. Sweeps
/// are left to the solver, which knows their work exactly [operations].
double forecast_work(const FrameProgress& at, const Settings& settings);

/// Whether every sub-step takes as much again: sweeps are a fixed number.
bool is_shared(const Settings& settings);

/// What the solver may take in the next sub-step. Sweeps come again in every sub-step: they share
/// what is left of the budget. A direct solve may take all of it.
SolveLimits limits_of_solve(const FrameProgress& at, const Settings& settings,
                            const Budget& budget);

}  // namespace substep
