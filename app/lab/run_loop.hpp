#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/lab.hpp"

namespace substep {

/// Repeats a run and what is compared with it: from the start to an end and again, in slow motion
/// around the moment at which one of them fails.
class RunLoop {
 public:
  struct Plan {
    double end = 4.0;         // where it starts again unless the run fails before [s]
    double slow_until = 0.0;  // in slow motion from its start until then [s]
  };
  /// One of the runs over a pass.
  struct Pass {
    bool stable = true;
    double failed_at = 0.0;  // where it is not [s]
    std::string reason;      // the verdict's
    double drift = 0.0;      // change of the total energy [J]
    int least_n = 0;         // sub-steps of a frame [-]
    int most_n = 0;
    std::int64_t substeps = 0;  // of all frames [-]
  };
  /// What the run came to with its present settings and load.
  struct Outcome {
    enum class Kind : unsigned char {
      kOpen,    // it has not reached the end yet
      kStable,  // a pass from start to end held
      kFailed
    };
    [[nodiscard]] bool open() const { return kind == Kind::kOpen; }
    [[nodiscard]] bool failed() const { return kind == Kind::kFailed; }

    Kind kind = Kind::kOpen;
    double time = 0.0;  // of the failure, or of the end [s]
    Pass run;
    std::vector<Pass> beside;  // what is compared with it
  };

  [[nodiscard]] bool open() const { return plan_.has_value(); }
  /// Repeats the run that is there now. A run that fails no longer pauses.
  void begin(Lab& lab, const Plan& plan);
  /// Before each picture.
  /// @param repeats otherwise it pauses at the end; played from there, it starts again
  void follow(Lab& lab, bool repeats);
  /// Ends it: the speed is the one of before.
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
  bool rested_ = false;            // it was paused at the end of this pass
  std::optional<double> failure_;  // the first of this pass, or of the pass before [s]
  bool failed_ = false;            // in this pass
  Settings settings_;              // that the outcome is of
  double load_ = 1.0;              // the same [-]
  bool whole_ = false;             // this pass has had them from its start
  bool stale_ = false;             // it failed with others
  Outcome outcome_;
};

}  // namespace substep
