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

/// Destination of each result: a file, "-" for standard output, "" for none.
struct RunFiles {
  std::string csv;
  std::string json;
  std::string states;
  std::string joints;

  void add_to(CLI::App& command);
  /// Throws a CLI::ValidationError if two results have the same destination, or one is the scene's
  /// file.
  void check(const std::string& scene) const;
  [[nodiscard]] bool take_standard_output() const;
};

/// Writes the results of a run frame by frame.
class RunOutputs {
 public:
  /// @return false, with a message on stderr, if one of them cannot be written
  bool open(const RunFiles& files);
  void begin(const Simulator& simulator, const FrameReport& start);
  void add(const Simulator& simulator, const FrameReport& frame);
  /// Whether a write failed; the run then stops.
  [[nodiscard]] bool failed() const;
  /// @return false, with a message on stderr, if anything could not be written
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
