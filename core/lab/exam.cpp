#include "core/lab/exam.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/lab/experiment.hpp"
#include "core/lab/stop_text.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Steps a run to its end and measures it.
class Run {
 public:
  Run(const ExamCase& exam, const Settings& settings, ExamRow& row)
      : exam_(exam),
        row_(row),
        simulator_(std::make_shared<const Scene>(exam.scene)),
        measure_(exam.measure()) {
    simulator_.set_measures({.energies = true, .errors = true, .stages = false});
    simulator_.set_settings(settings);
  }

  void all() {
    const std::int64_t frames = frames_of(exam_.scene, exam_.scene.criteria.duration);
    row_.errors.assign(exam_.quantities.size(), 0.0);
    if (!exam_.needs_forces) look(simulator_.state(), simulator_.observe(), {});
    for (std::int64_t i = 0; i < frames && row_.status.empty(); ++i) frame();
    const std::int64_t done = simulator_.state().frame;
    if (exam_.needs_forces && row_.status.empty()) look_ahead();
    row_.substeps /= static_cast<double>(std::max<std::int64_t>(1, done));
    if (!row_.status.empty()) std::fill(row_.errors.begin(), row_.errors.end(), kInfinite);
  }

 private:
  void look(const State& state, const FrameReport& report, const ConstraintForces& forces) {
    measure_({exam_.scene, state, report, forces}, row_.errors);
  }
  /// The forces at the state's time are those of the sub-step that begins there.
  FrameReport look_ahead() {
    const State state = simulator_.state();
    const FrameReport report = simulator_.observe();
    FrameReport begun = simulator_.substep();
    look(state, report, simulator_.constraint_forces());
    return begun;
  }
  void frame() {
    FrameReport report;
    if (exam_.needs_forces) report = look_ahead();
    // A frame with one sub-step is complete here.
    if (!exam_.needs_forces || simulator_.substeps_left() > 0) report = simulator_.step();
    row_.substeps += report.n_substeps + report.n_discarded;
    row_.status = stop_text(exam_.scene, report);
    if (row_.status.empty() && !exam_.needs_forces) look(simulator_.state(), report, {});
  }

  const ExamCase& exam_;
  ExamRow& row_;
  Simulator simulator_;
  ExamMeasure measure_;
};

/// Order relative to the previous row, if both errors are in the valid range.
std::optional<double> observed_order(const ExamCase& exam, const ExamRow& coarse,
                                     const ExamRow& fine) {
  const double a = coarse.errors.front();
  const double b = fine.errors.front();
  const bool shows = b >= exam.least_for_order && a <= exam.most_for_order && b > 0.0;
  if (!shows || fine.substeps <= coarse.substeps) return std::nullopt;
  return std::log(a / b) / std::log(fine.substeps / coarse.substeps);
}

ExamRow run_one(const ExamCase& exam, const ExamMethod& method, double value) {
  ExamRow row;
  Settings settings = method.settings;
  row.method = method.name;
  row.value = value;
  if (settings.mode == Mode::kAdaptive) {
    row.parameter = "alpha";
    settings.alpha = value;
  } else {
    row.parameter = "n";
    settings.n = static_cast<int>(value);
  }
  const auto start = std::chrono::steady_clock::now();
  Run(exam, settings, row).all();
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  row.passes = true;
  for (std::size_t i = 0; i < exam.quantities.size(); ++i) {
    const ExamQuantity& quantity = exam.quantities[i];
    // The comparison is false for NaN.
    const bool within = row.errors[i] <= quantity.tolerance;
    row.within.push_back(within);
    row.passes = row.passes && within;
    row.keeps = row.keeps && (within || !quantity.for_every_run);
  }
  return row;
}

/// The order of a method is checked on the finest valid pair of runs: coarser ones may be outside
/// the asymptotic range.
void judge_order(const ExamMethod& method, std::vector<ExamRow>& rows) {
  if (!method.order) return;
  const auto finest =
      std::find_if(rows.rbegin(), rows.rend(), [](const ExamRow& row) { return row.order; });
  if (finest == rows.rend()) return;
  finest->expected_order = method.order;
  finest->keeps = finest->keeps && *finest->order >= *method.order - kOrderAllowance;
}

/// The largest error of a row relative to its tolerance.
double distance(const ExamCase& exam, const ExamRow& row) {
  double worst = 0.0;
  for (std::size_t i = 0; i < row.errors.size(); ++i) {
    const double share = row.errors[i] / exam.quantities[i].tolerance;
    worst = share <= worst ? worst : share;
  }
  return worst;
}

}  // namespace

std::size_t ExamResult::best(const ExamCase& exam) const {
  const auto is_better = [&](const ExamRow& a, const ExamRow& b) {
    if (a.passes != b.passes) return a.passes;
    return a.passes ? a.substeps < b.substeps : distance(exam, a) < distance(exam, b);
  };
  return static_cast<std::size_t>(std::min_element(rows.begin(), rows.end(), is_better) -
                                  rows.begin());
}

ExamResult run_exam(const ExamCase& exam, const std::function<void(const ExamRow&)>& on_row) {
  ExamResult result;
  for (const ExamMethod& method : exam.methods) {
    std::vector<ExamRow> rows;
    for (const double value : method.parameters) {
      ExamRow row = run_one(exam, method, value);
      if (!rows.empty()) row.order = observed_order(exam, rows.back(), row);
      rows.push_back(std::move(row));
    }
    judge_order(method, rows);
    for (ExamRow& row : rows) {
      result.reached = result.reached || row.passes;
      result.kept = result.kept && row.keeps;
      if (on_row) on_row(row);
      result.rows.push_back(std::move(row));
    }
  }
  return result;
}

std::vector<ExamMethod> exam_methods(const Settings& base, const std::vector<double>& n) {
  std::vector<ExamMethod> methods;
  Settings settings = base;
  settings.mode = Mode::kAdaptive;
  settings.n_max = 4096;  // alpha decides, not the cap
  methods.push_back({"euler, adaptive", settings, {0.1, 0.01, 0.001}, std::nullopt});
  settings = base;
  settings.mode = Mode::kConst;
  methods.push_back({"euler", settings, n, 1.0});
  settings.integrator = Integrator::kLeapfrog;
  methods.push_back({"leapfrog", settings, n, 2.0});
  settings.integrator = Integrator::kStormer;
  methods.push_back({"stormer", settings, n, 4.0});
  settings.integrator = Integrator::kLeapfrog;
  settings.solver = SolverKind::kNewton;
  settings.iterations = 2;  // with one, Numerov's forces are of third order
  settings.forces = Forces::kMean;
  methods.push_back({"newton mean", settings, n, 2.0});
  settings.forces = Forces::kNumerov;
  methods.push_back({"newton numerov", settings, n, 4.0});
  return methods;
}

}  // namespace substep
