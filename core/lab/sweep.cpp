#include "core/lab/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/lab/slice.hpp"
#include "core/model/methods.hpp"
#include "core/model/validate.hpp"
#include "core/sim/islands.hpp"

namespace substep {
namespace {

constexpr int kConstant[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 40, 56, 80};
constexpr int kImplicit[] = {1, 2, 3, 4, 6, 8, 11, 16, 28, 56};  // these solvers need few
constexpr int kNewtonSteps[] = {1, 2};                           // enough in short sub-steps
constexpr int kSmallSteps[] = {1, 2, 4, 8, 16, 32, 64};  // they share as many sweeps as the last
constexpr int kRefinements[] = {2, 8};
constexpr int kFew[] = {1, 2, 3, 4, 6, 8};  // sub-steps that are refined
constexpr double kAlpha[] = {1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.1, 0.05, 0.025, 0.0125, 0.00625};
constexpr double kDampingAlpha[] = {1.0, 0.5, 0.25, 0.1, 0.05};
constexpr int kFreeCap = 256;  // of adaptive sub-steps
constexpr int kCaps[] = {1, 2, 3, 4, 6, 8, 12};
// The map has fewer values than the curves, because each requires a run under every load.
constexpr int kMapN[] = {1, 2, 4, 6, 8, 12, 16, 24};
constexpr std::array kMapAlpha{1.0, 0.5, 0.25, 0.1, 0.05};
constexpr double kMapLoads[] = {0.01, 0.1, 0.32, 3.2, 10.0};
constexpr double kReferenceWork = 0.05;  // share of the progress bar

/// True if rows of the scene may open, close, or reach a bound.
bool has_bounds(const Scene& scene) {
  return scene.effects.contact || acts_on_coordinates(scene.effects);
}

/// With the direct solver, N decided once per frame.
Settings direct(Settings settings, Integrator integrator) {
  settings.solver = SolverKind::kBpp;
  settings.policy = Policy::kFrame;
  settings.integrator = integrator;
  return settings;
}

/// The settings with every value of one of their members.
void append_along(Settings settings, const auto& values, auto member, std::vector<Settings>& all) {
  for (const auto value : values) {
    settings.*member = value;
    all.push_back(settings);
  }
}

/// Every value of a mode's own parameter.
void append_curve(Settings settings, Mode mode, std::vector<Settings>& all) {
  settings.mode = mode;
  switch (entry_of(mode).count) {
    case SubstepCount::kOne:
      if (reads(settings, "alpha")) {
        append_along(settings, kDampingAlpha, &Settings::alpha, all);
      } else {
        all.push_back(settings);
      }
      break;
    case SubstepCount::kGiven:
      append_along(settings, kConstant, &Settings::n, all);
      break;
    case SubstepCount::kStableCapped:
      append_along(settings, kCaps, &Settings::n_cap, all);
      break;
    case SubstepCount::kStable:
      // A low cap would hide the effect of alpha.
      settings.n_max = std::max(settings.n_max, kFreeCap);
      append_along(settings, kAlpha, &Settings::alpha, all);
      break;
  }
}

/// Solvers that hold constraints at the end of a sub-step, with constant N: their papers give no
/// rule for N.
void append_implicit(Settings settings, const Scene& scene, std::vector<Settings>& all) {
  settings.mode = Mode::kConst;
  settings.policy = Policy::kFrame;
  const auto along = [&](SolverKind solver, int iterations, Forces forces) {
    settings.solver = solver;
    settings.iterations = iterations;
    settings.forces = forces;
    settings.integrator = forces == Forces::kEnd ? Integrator::kEuler : Integrator::kLeapfrog;
    append_along(settings, kImplicit, &Settings::n, all);
  };
  const int iterations = settings.iterations;  // along() changes them
  for (const SolverEntry& solver : kSolvers) {
    if (!solver.at_end) continue;
    if (solver.sweeps) along(solver.value, 1, Forces::kEnd);  // XPBD as published
    along(solver.value, iterations, Forces::kEnd);
  }
  for (const int steps : kNewtonSteps) along(SolverKind::kNewton, steps, Forces::kMean);
  along(SolverKind::kNewton, iterations, Forces::kMean);
  if (has_bounds(scene)) return;  // the following is derived for joints only
  for (const int steps : kNewtonSteps) along(SolverKind::kNewton, steps, Forces::kNumerov);
  along(SolverKind::kNewton, iterations, Forces::kNumerov);
}

/// Small steps (Macklin et al. 2019): a fixed number of sweeps per frame over an increasing number
/// of sub-steps, with contacts detected once.
void append_small_steps(Settings settings, const Scene& scene, std::vector<Settings>& all) {
  settings.mode = Mode::kConst;
  settings.policy = Policy::kFrame;
  settings.integrator = Integrator::kEuler;
  settings.iterations = *std::rbegin(kSmallSteps);
  settings.share_iterations = true;
  if (scene.effects.contact) settings.detection = Detection::kFrame;
  for (const SolverEntry& solver : kSolvers) {
    settings.solver = solver.value;
    if (solver.sweeps) append_along(settings, kSmallSteps, &Settings::n, all);
  }
}

/// Few sub-steps, with refinements that remove most of the regularisation.
void append_refined(const Settings& base, std::vector<Settings>& all) {
  Settings settings = direct(base, Integrator::kEuler);
  settings.mode = Mode::kConst;
  for (const int refinements : kRefinements) {
    settings.refinements = refinements;
    append_along(settings, kFew, &Settings::n, all);
  }
}

/// True if joints do not connect all moving bodies.
bool can_have_islands(const Scene& scene) {
  const State state = initial_state(scene);
  std::vector<Mat3> R_WB;
  for (const Quat& q : state.q) R_WB.emplace_back(q.toRotationMatrix());
  Islands islands(scene);
  islands.find(scene, whole(scene), state, R_WB, scene.frame, nullptr);
  return islands.count() > 1;
}

/// Constant N and adaptive along their parameter, with the direct solver, under every other load.
void append_map(const Settings& base, std::vector<SweepPoint>& points) {
  const Settings settings = direct(base, Integrator::kEuler);
  std::vector<Settings> all;
  append_curve(settings, Mode::kConst, all);
  append_curve(settings, Mode::kAdaptive, all);
  const auto is_on_map = [](const Settings& s) {
    return s.mode == Mode::kConst
               ? std::find(std::begin(kMapN), std::end(kMapN), s.n) != std::end(kMapN)
               : std::find(kMapAlpha.begin(), kMapAlpha.end(), s.alpha) != kMapAlpha.end();
  };
  for (const Settings& on_map : all) {
    if (!is_on_map(on_map)) continue;
    for (const double load : kMapLoads) points.push_back({on_map, load});
  }
}

// Those that base_of() resets, and that the curves set.
constexpr std::string_view kSwept[] = {
    "solver",
    "share_iterations",
    "refinements",
    "forces",
    "mode",
    "n",
    "policy",
    "hold",
    "redo",
    "integrator",
    "gyroscopic",
    "drift",
    "drift_order",
    "detection",
    "contact_stiffness",
    "islands",
    "sleep",
    "watch_stiffness",
};

/// The scene's own settings, with those that have their own curves reset.
Settings base_of(const Scene& scene) {
  Settings base = own_settings(scene);
  base.forces = Forces::kEnd;
  base.watch_stiffness = false;
  base.drift = Drift::kAuto;
  base.drift_order = 1;
  base.contact_stiffness = ContactStiffness::kPaper;
  base.gyroscopic = Gyroscopic::kImplicit;
  base.share_iterations = false;
  base.refinements = 0;
  base.detection = Detection::kSubstep;
  base.hold = 1;
  base.redo = false;
  base.islands = false;
  base.sleep = false;
  return base;
}

}  // namespace

std::span<const std::string_view> swept_settings() { return kSwept; }

std::span<const double> map_alphas() { return kMapAlpha; }

void append_defaults(std::vector<SweepPoint>& points) {
  std::vector<Settings> all;
  append_along(Settings{}, kAlpha, &Settings::alpha, all);
  for (const Settings& settings : all) points.push_back({settings});
}

Settings paper_settings(const Scene& scene) {
  Settings paper = direct(base_of(scene), Integrator::kEuler);
  paper.mode = Mode::kAdaptive;
  paper.n_max = std::max(paper.n_max, kFreeCap);
  return paper;
}

std::vector<SweepPoint> default_sweep(const Scene& scene) {
  if (!is_runnable(scene)) return {};
  std::vector<Settings> all;
  const Settings base = base_of(scene);
  const auto curves = [&](SolverKind solver, Integrator integrator) {
    Settings settings = base;
    settings.solver = solver;
    settings.integrator = integrator;
    settings.policy = Policy::kFrame;
    append_curve(settings, Mode::kConst, all);
    append_curve(settings, Mode::kAdaptive, all);
    settings.policy = Policy::kSubstep;
    if (solver == SolverKind::kBpp) append_curve(settings, Mode::kAdaptive, all);
    settings.policy = Policy::kFrame;
    for (const Mode mode :
         {Mode::kInertia, Mode::kBlend, Mode::kStiffness, Mode::kDamping, Mode::kCapped}) {
      append_curve(settings, mode, all);
    }
  };
  for (const SolverKind solver : listed_solvers()) {
    if (entry_of(solver).at_end) continue;  // append_implicit and append_small_steps
    curves(solver, Integrator::kEuler);
    curves(solver, Integrator::kLeapfrog);
  }
  const auto direct_curve = [&](Integrator integrator, Mode mode, auto member, auto value) {
    Settings settings = direct(base, integrator);
    settings.*member = value;
    append_curve(settings, mode, all);
  };
  if (scene.effects.joints) {
    direct_curve(Integrator::kLeapfrog, Mode::kConst, &Settings::drift_order, 2);
  }
  if (scene.effects.joints && !has_bounds(scene)) {  // it is derived for joints only
    append_curve(direct(base, Integrator::kStormer), Mode::kConst, all);
    append_curve(direct(base, Integrator::kStormer), Mode::kAdaptive, all);
  }
  if (scene.effects.contact) {
    direct_curve(Integrator::kEuler, Mode::kAdaptive, &Settings::contact_stiffness,
                 ContactStiffness::kExact);
  }
  append_implicit(base, scene, all);
  append_small_steps(base, scene, all);
  if (scene.regularisation > 0.0) append_refined(base, all);
  if (scene.effects.gyroscopic) {
    direct_curve(Integrator::kLeapfrog, Mode::kConst, &Settings::gyroscopic, Gyroscopic::kExplicit);
  }
  if (can_have_islands(scene)) {
    direct_curve(Integrator::kEuler, Mode::kAdaptive, &Settings::islands, true);
    direct_curve(Integrator::kLeapfrog, Mode::kAdaptive, &Settings::islands, true);
    direct_curve(Integrator::kEuler, Mode::kCapped, &Settings::islands, true);
  }
  std::vector<SweepPoint> points;
  for (auto s = all.begin(); s != all.end(); ++s) {  // the scene's own may equal those of a curve
    if (std::find(all.begin(), s, *s) == s) points.push_back({*s, 1.0});
  }
  if (mass_ratio(scene) > 1.0) append_map(base, points);
  return points;
}

double expected_work(const Scene& scene, const Experiment& experiment) {
  const Settings& s = experiment.settings;
  double n = 1.0;
  if (reads(s, "n")) n = s.n;
  if (reads(s, "n_cap")) n = s.n_cap;
  if (reads(s, "n_max")) n = std::min<double>(s.n_max, 5.0 / std::sqrt(s.alpha));
  const SolverEntry& solver = entry_of(s.solver);
  double iterations = 1.0;
  if (solver.sweeps) {
    iterations = s.share_iterations ? std::max(1.0, s.iterations / n) : s.iterations;
  } else if (reads(s, "iterations")) {
    iterations = std::min(3, s.iterations);  // it has then converged
  }
  const double per_substep = solver.work * iterations;  // in solves of the direct solver, about
  const double per_frame = 0.5;                         // errors and energies, independent of N
  return static_cast<double>(frames_of(scene, experiment.duration)) * (per_frame + n * per_substep);
}

Sweep::Sweep(std::shared_ptr<const Scene> scene, std::vector<Experiment> experiments,
             const Budget& budget)
    : scene_(not_null(std::move(scene))), experiments_(std::move(experiments)), budget_(budget) {
  double longest = 0.0;
  for (const Experiment& experiment : experiments_) {
    work_ += expected_work(*scene_, experiment);
    longest = std::max(longest, experiment.duration);
  }
  finding_reference_.emplace(scene_, longest, budget_);
}

void Sweep::advance_by_a_frame() {
  if (finding_reference_) {
    if (finding_reference_->advance()) return;
    reference_ = std::make_unique<const Reference>(finding_reference_->reference());
    finding_reference_.reset();
    return;
  }
  if (!run_) {
    run_ = std::make_unique<ExperimentRun>(*scene_, experiments_[next_++], *reference_, budget_);
    return;
  }
  if (run_->advance()) return;
  results_.push_back(run_->result());
  work_done_ += expected_work(*scene_, run_->experiment());
  run_.reset();
}

bool Sweep::advance(double seconds) {
  return advance_for(seconds, [this] {
    if (!done()) advance_by_a_frame();
    return !done();
  });
}

double Sweep::progress() const {
  if (done()) return 1.0;
  if (finding_reference_) return kReferenceWork * finding_reference_->progress();
  double work = work_done_;
  if (run_) work += run_->progress() * expected_work(*scene_, run_->experiment());
  return work_ > 0.0 ? kReferenceWork + (1.0 - kReferenceWork) * work / work_ : 1.0;
}

}  // namespace substep
