#pragma once
// The exam: scenes with a published or closed-form solution, run by several methods and compared
// with it. Without file access or output.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/constraint_forces.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// One quantity of a case, compared with its reference.
struct ExamQuantity {
  std::string name;            // "position"
  std::string unit;            // "m"
  double tolerance = 0.0;      // largest error that passes, from the reference's precision [unit]
  std::string why;             // where the tolerance comes from
  bool for_every_run = false;  // the limit for all methods and numbers of sub-steps
};

/// Input of a case's measure, once per frame.
struct ExamView {
  const Scene& scene;
  const State& state;
  const FrameReport& report;
  /// Of the sub-step that begins at the state's time; empty unless ExamCase::needs_forces. A
  /// sub-step's constraint forces belong to the poses that it starts from, to second order.
  const ConstraintForces& forces;
};

/// Updates the errors so far, one per quantity, initially zero. A measure belongs to one run and
/// may keep state.
using ExamMeasure = std::function<void(const ExamView&, std::span<double> errors)>;

/// The reference motion: sets the poses of the bodies it covers. @param t no less than at the last
/// call [s]  @param x, q per body, initially the scene's [m, -]
using ExamMotion = std::function<void(double t, std::vector<Vec3>& x, std::vector<Quat>& q)>;

/// A method and the settings that a case runs it with.
struct ExamMethod {
  std::string name;  // "leapfrog"
  Settings settings;
  std::vector<double> parameters;  // sub-steps per frame, or alpha in mode kAdaptive
  std::optional<double> order;     // required order of the first quantity; none: unchecked
};

/// A scene and its reference.
struct ExamCase {
  std::string name;        // "four_bar"
  std::string title;       // for people
  std::string source;      // source of the reference values
  std::string definition;  // of the scene, in a sentence or two
  Scene scene;             // run for criteria.duration
  std::vector<ExamQuantity> quantities;
  std::function<ExamMeasure()> measure;
  std::function<ExamMotion()> motion;  // the reference motion; empty if it has no poses
  std::vector<ExamMethod> methods;
  bool needs_forces = false;
  /// Errors of the first quantity between these are used for the order: below, the reference or
  /// rounding limits the accuracy; above, the step is outside the asymptotic range.
  double least_for_order = 0.0;
  double most_for_order = 0.0;
};

/// A case by name; it is built on demand, because some references are integrated.
struct ExamEntry {
  std::string name;
  std::string title;
  ExamCase (*build)() = nullptr;
};

/// One run.
struct ExamRow {
  std::string method;
  std::string parameter;                 // "n" or "alpha"
  double value = 0.0;                    // of the parameter
  double substeps = 0.0;                 // mean per frame
  std::vector<double> errors;            // per quantity; infinite if the run failed
  std::vector<bool> within;              // per quantity: true if within tolerance
  std::optional<double> order;           // relative to the previous row of the same method
  std::optional<double> expected_order;  // if the order is checked in this row
  bool passes = false;                   // all quantities are within their tolerance
  bool keeps = true;                     // the order and the limits for every run are met
  std::string status;                    // cause of failure, or empty
  double seconds = 0.0;                  // wall time [s]
};

/// A case passes if at least one run is within all tolerances and every run meets its method's
/// order and the limits for every run.
struct ExamResult {
  std::vector<ExamRow> rows;
  bool reached = false;  // a run is within all tolerances
  bool kept = true;      // every run meets its requirements
  [[nodiscard]] bool passed() const { return reached && kept; }
  /// Index of the run with the fewest sub-steps within all tolerances, else of the closest one.
  [[nodiscard]] std::size_t best(const ExamCase& exam) const;
};

/// Runs every method of a case. @param on_row called after each run, may be empty
ExamResult run_exam(const ExamCase& exam, const std::function<void(const ExamRow&)>& on_row = {});

/// The methods for smooth motions: the paper's (Euler, adaptive, by alpha), and by n Euler,
/// leapfrog, Störmer and Newton with mean forces and with Numerov's weights.
/// @param base all other settings  @param n sub-steps per frame, ascending
std::vector<ExamMethod> exam_methods(const Settings& base, const std::vector<double>& n);

/// Allowed shortfall of the observed order of convergence.
inline constexpr double kOrderAllowance = 0.4;

}  // namespace substep
