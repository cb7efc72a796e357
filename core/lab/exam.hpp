#pragma once
// The exam: scenes with a published answer or a closed form, run
// by several methods and measured from that answer. No file is read and nothing is printed here.

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

/// One figure that a case compares with its reference.
struct ExamQuantity {
  std::string name;            // "position"
  std::string unit;            // "m"
  double tolerance = 0.0;      // largest error that passes, from the reference's precision [unit]
  std::string why;             // where the tolerance comes from
  bool for_every_run = false;  // no method may exceed it, at any number of sub-steps
};

/// What a case looks at, once a frame.
struct ExamView {
  const Scene& scene;
  const State& state;
  const FrameReport& report;
  /// Of the sub-step that begins at the state's time; empty unless ExamCase::needs_forces. A
  /// sub-step's constraint forces belong to the poses that it starts from, to second order.
  const ConstraintForces& forces;
};

/// Updates the errors so far, one per quantity and zero at first. A measure belongs to one run and
/// may remember what it has seen.
using ExamMeasure = std::function<void(const ExamView&, std::span<double> errors)>;

/// Where bodies should be: sets the poses of those that it knows. @param t no less than at the last
/// call [s]  @param x, q per body, at the start the scene's [m, -]
using ExamMotion = std::function<void(double t, std::vector<Vec3>& x, std::vector<Quat>& q)>;

/// A method and the settings that a case runs it with.
struct ExamMethod {
  std::string name;  // "leapfrog"
  Settings settings;
  std::vector<double> parameters;  // sub-steps per frame, or alpha in mode kAdaptive
  std::optional<double> order;     // that the first quantity has to fall with; none: not judged
};

/// A scene and its reference.
struct ExamCase {
  std::string name;        // "four_bar"
  std::string title;       // for people
  std::string source;      // whose numbers these are
  std::string definition;  // of the scene, in a sentence or two
  Scene scene;             // criteria.duration is how long it runs
  std::vector<ExamQuantity> quantities;
  std::function<ExamMeasure()> measure;
  std::function<ExamMotion()> motion;  // the reference to look at; empty where it has no poses
  std::vector<ExamMethod> methods;
  bool needs_forces = false;
  /// Errors of the first quantity between these show a method's order: below, the reference's or
  /// rounding's last digits stand, above, the step is too long for its order.
  double least_for_order = 0.0;
  double most_for_order = 0.0;
};

/// A case by name; it is built on demand, because some references are integrated.
struct ExamEntry {
  std::string name;
  std::string title;
  std::string not_reached;  // what the vocabulary lacks for it, or empty
  ExamCase (*build)() = nullptr;
};

/// One run.
struct ExamRow {
  std::string method;
  std::string parameter;                 // "n" or "alpha"
  double value = 0.0;                    // of the parameter
  double substeps = 0.0;                 // of a frame, mean
  std::vector<double> errors;            // per quantity; infinite where the run failed
  std::vector<bool> within;              // per quantity: its tolerance
  std::optional<double> order;           // against the row before, of the same method
  std::optional<double> expected_order;  // where the method is judged by this row
  bool passes = false;                   // all quantities are within their tolerance
  bool keeps = true;                     // order as expected, and what every run has to keep
  std::string status;                    // why a run failed, or empty
  double seconds = 0.0;                  // wall time [s]
};

/// A case passes where at least one run is within all tolerances and every run keeps what it
/// should: its method's order, and the quantities that are for every run.
struct ExamResult {
  std::vector<ExamRow> rows;
  bool reached = false;  // a run is within all tolerances
  bool kept = true;      // every run keeps what it should
  [[nodiscard]] bool passed() const { return reached && kept; }
  /// Index of the run within all tolerances that takes the fewest sub-steps, else of the one that
  /// is closest to them.
  [[nodiscard]] std::size_t best(const ExamCase& exam) const;
};

/// Runs every method of a case. @param on_row called after each run, may be empty
ExamResult run_exam(const ExamCase& exam, const std::function<void(const ExamRow&)>& on_row = {});

/// The methods that a smooth motion is run with: the paper's (Euler, adaptive, by alpha), and by n
/// Euler, leapfrog, Störmer and Newton with mean forces and with Numerov's weights.
/// @param base everything else  @param n sub-steps per frame, ascending
std::vector<ExamMethod> exam_methods(const Settings& base, const std::vector<double>& n);

/// How far a method's observed order may fall short of its own.
inline constexpr double kOrderAllowance = 0.4;

}  // namespace substep
