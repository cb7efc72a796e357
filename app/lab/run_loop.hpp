#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/lab/lab.hpp"

namespace substep {

/// Repeats a run and those compared with it from start to end, in slow motion around the first
/// failure.
class RunLoop {
 public:
  struct Plan {
    double end = 4.0;         // restarts here unless the run fails earlier [s]
    double slow_until = 0.0;  // slow motion from the start until this time [s]
  };
  /// One run over one pass.
  struct Pass {
    bool stable = true;
    double failed_at = 0.0;            // if not stable [s]
    std::optional<Exceeded> exceeded;  // the criterion that failed the pass
    double drift = 0.0;                // change of the total energy [J]
    int least_n = 0;                   // sub-steps per frame [-]
    int most_n = 0;
    std::int64_t substeps = 0;  // of all frames [-]
  };
  /// Result of the run with its current settings and load.
  struct Outcome {
    enum class Kind : unsigned char {
      kOpen,    // the end is not reached yet
      kStable,  // stable over a whole pass
      kFailed
    };
    [[nodiscard]] bool open() const { return kind == Kind::kOpen; }
    [[nodiscard]] bool failed() const { return kind == Kind::kFailed; }

    Kind kind = Kind::kOpen;
    double time = 0.0;  // of the failure, or of the end [s]
    Pass run;
    std::vector<Pass> beside;  // the runs compared with it
  };

  [[nodiscard]] bool open() const { return plan_.has_value(); }
  /// Starts to repeat the current run. Disables the pause at failure.
  void begin(Lab& lab, const Plan& plan);
  /// Call before each drawn frame.
  /// @param repeats false: pauses at the end; playing again restarts it
  void follow(Lab& lab, bool repeats);
  /// Stops repeating and restores the speed.
  void end(Lab& lab);
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
  void observe(const Lab& lab);
  void conclude(const Lab& lab, Outcome::Kind kind, double time);
  void set_slow(Lab& lab, bool slow);
  void start_again(Lab& lab);
  [[nodiscard]] bool is_slow_at(double time) const;

  std::optional<Plan> plan_;
  double speed_ = 1.0;  // outside slow motion [-]
  bool slow_ = false;
  bool rested_ = false;            // paused at the end of this pass
  std::optional<double> failure_;  // the first of this or the previous pass [s]
  bool failed_ = false;            // in this pass
  Settings settings_;              // of the outcome
  double load_ = 1.0;              // of the outcome [-]
  bool whole_ = false;             // settings and load are unchanged since the start of this pass
  bool stale_ = false;             // it failed with other settings or load
  Outcome outcome_;
};

}  // namespace substep
