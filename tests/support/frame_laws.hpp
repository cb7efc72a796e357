#pragma once
// Invariants of every frame of every scene: numbers stay finite or the run stops with a status, and
// the work is within the bounds of the settings.

#include <algorithm>
#include <cmath>
#include <string>

#include "core/sim/simulator.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {

/// Fewer sub-steps, sweeps and pivots, so that a run with any settings is short. The rest is
/// unchanged.
inline Settings shortened(Settings settings, int most_substeps) {
  settings.n = std::min(settings.n, most_substeps);
  settings.n_max = std::min(settings.n_max, most_substeps);
  settings.n_cap = std::min(settings.n_cap, most_substeps);
  settings.iterations = std::min(settings.iterations, 50);
  settings.pivots = std::min(settings.pivots, 50);
  return settings;
}

/// The first part of a state that is not finite, or "".
inline std::string not_finite(const State& state) {
  const auto finite = [](const auto& m) { return m.allFinite(); };
  const auto all = [&](const auto& list) { return std::all_of(list.begin(), list.end(), finite); };
  if (!std::isfinite(state.time + state.dt_previous)) return "time";
  if (!all(state.x)) return "positions";
  if (!std::all_of(state.q.begin(), state.q.end(),
                   [&](const Quat& q) { return finite(q.coeffs()); })) {
    return "orientations";
  }
  if (!all(state.u)) return "velocities";
  if (!all(state.u_synchronised)) return "synchronised velocities";
  if (!all(state.k) || !all(state.K_resisting)) return "stiffness";
  if (!std::isfinite(state.r)) return "r";
  for (const OwnSubstep& own : state.own) {
    if (!std::isfinite(own.dt_previous + own.r)) return "islands";
  }
  for (const StoredForce& force : state.forces) {
    if (!std::all_of(force.lambda, force.lambda + 5, [](double f) { return std::isfinite(f); })) {
      return "forces";
    }
  }
  return "";
}

inline int most_substeps(const Settings& settings) {
  switch (settings.mode) {
    case Mode::kNone:
    case Mode::kDamping:
    case Mode::kStiffness:
      return 1;
    case Mode::kConst:
      return settings.n;
    case Mode::kAdaptive:
      return settings.n_max;
    case Mode::kCapped:
    case Mode::kInertia:
    case Mode::kBlend:
      return settings.n_cap;
    case Mode::kCount:
      break;
  }
  return 0;
}

/// The law that a frame violates, or "".
inline std::string broken_law(const Scene& scene, const Settings& settings, const State& state,
                              const FrameReport& report) {
  if (const std::string what = not_finite(state); !what.empty()) {
    return "the state is finite, not its " + what;
  }
  if (report.status == StepStatus::kNotFinite &&
      (report.failed_body < 0 || report.failed_body >= static_cast<int>(scene.bodies.size()))) {
    return "a frame that fails names a body";
  }
  for (const Quat& q : state.q) {
    if (std::abs(q.norm() - 1.0) > 1e-5) return "orientations have length 1";
  }
  const bool all_sleep = report.asleep > 0 && report.n_substeps == 0;
  const bool sweeps = settings.detection == Detection::kContinuous;
  const int most = most_substeps(settings);
  const int shortened = sweeps ? std::max(4, most / 4) : 0;  // by impacts
  if ((report.n_substeps < 1 && !all_sleep) || report.n_substeps > most + shortened) {
    return "1 <= N <= its cap";
  }
  const SolverWork& work = report.work;
  // Islands take separate sub-steps; islands with the same number are stepped together.
  const std::int64_t substeps = std::int64_t{report.n_substeps} * std::max(1, report.islands);
  // Contacts found along the motion: at most 8 solves, each with three softnesses, and once more if
  // rebounds add energy, and 4 for shifts; all that for up to five lengths.
  const std::int64_t most_solves = sweeps ? 5 * (8 * 3 * 2 + 4) : 1;
  if (work.solves - work.impacts > most_solves * substeps + 1) {
    return "solves of a sub-step are bounded";
  }
  if (work.impacts > 200 * most_solves * substeps) return "impacts are bounded";
  if (!(report.n_mean <= report.n_substeps)) return "the mean N is no more than the largest";
  // Newton solves with BPP in each of its iterations, and so do each refinement and each of at most
  // 30 solves that close joints. Impacts are solved with BPP, but with PGS by PGS.
  const int of_bpp = 1 + settings.refinements;
  const int of_joints = settings.drift == Drift::kExact ? 30 : 1;
  const int of_a_solve = settings.solver == SolverKind::kNewton ? settings.iterations
                         : settings.solver == SolverKind::kBpp  ? of_joints * of_bpp
                         : sweeps                               ? of_joints * of_bpp
                                                                : 1;
  const std::int64_t linear =
      (work.solves - work.impacts) * of_a_solve + std::int64_t{work.impacts} * of_bpp;
  if (work.passes > 4 * linear) return "at most four passes a linear solve";
  // bpp.hpp: `pivots` block pivots a pass, then single ones, of which 51 end the solve.
  if (work.pivots > linear * (4L * settings.pivots + 51)) return "pivots are bounded";
  if (work.iterations > work.solves * settings.iterations) return "iterations are bounded";
  const auto n = static_cast<std::int64_t>(scene.bodies.size());
  if (report.contact_rows > 8 * n * (n - 1) / 2) return "at most eight contacts a pair";
  return "";
}

}  // namespace substep::test
