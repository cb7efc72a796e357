#include "core/sim/budget.hpp"

#include <algorithm>

namespace substep {
namespace {

constexpr double kBodyWork = 200.0;    // per body: external forces, masses, pose
constexpr double kBlockWork = 1000.0;  // per joint or contact: detection, rows, storage, report
constexpr int kTypical = 16;           // sub-steps whose mean predicts the others

double work_of_bodies(const FrameProgress& at) {
  return kBodyWork * static_cast<double>(at.bodies) * at.left;
}

}  // namespace

double work_beside_solver(const FrameProgress& at) {
  return kBodyWork * static_cast<double>(at.bodies) + kBlockWork * static_cast<double>(at.blocks);
}

bool is_shared(const Settings& settings) {
  return settings.solver == SolverKind::kPgs || settings.solver == SolverKind::kXpbd;
}

double forecast_work(const FrameProgress& at, const Settings& settings) {
  const double done = static_cast<double>(at.flops);
  double to_come = work_of_bodies(at);
  if (!is_shared(settings) && at.taken >= kTypical) to_come += done / at.taken * at.left;
  return done + to_come;
}

SolveLimits limits_of_solve(const FrameProgress& at, const Settings& settings,
                            const Budget& budget) {
  const double left = budget.work - static_cast<double>(at.flops) - work_of_bodies(at);
  const double in_frame = is_shared(settings) ? left / at.left : left;
  return {budget.memory, std::min(in_frame, budget.substep - work_beside_solver(at))};
}

}  // namespace substep
