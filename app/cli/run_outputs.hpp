#pragma once
// The result files of `substep run`.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cli/output.hpp"
#include "core/io/frame_columns.hpp"
#include "core/lab/metrics.hpp"
#include "core/sim/simulator.hpp"

namespace substep::cli {

/// Where each result goes: a file, "-" for standard output, "" for nowhere.
struct RunFiles {
  std::string csv;
  std::string json;
  std::string states;
  std::string joints;

  void add_to(CLI::App& command);
  /// Throws a CLI::ValidationError where two results go to the same place, or one to the scene's.
  void check(const std::string& scene) const;
  [[nodiscard]] bool take_standard_output() const;
};

/// Writes the results of a run as it goes.
class RunOutputs {
 public:
  /// @return false and a message on stderr where one of them cannot be written
  bool open(const RunFiles& files);
  void begin(const Simulator& simulator);
  void add(const Simulator& simulator, const FrameReport& frame);
  /// Whether a result could not be written; the run stops then.
  [[nodiscard]] bool failed() const;
  /// @return false and a message on stderr where not all could be written
  bool end(const Simulator& simulator, const Measure& measure);

 private:
  Output csv_;
  Output json_;
  Output states_;
  Output joints_;
  std::vector<FrameColumn> columns_;
  const char* separator_ = "\n    ";
};

}  // namespace substep::cli
