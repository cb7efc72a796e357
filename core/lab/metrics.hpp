#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/bounded_sample.hpp"
#include "core/lab/reference.hpp"
#include "core/lab/verdict.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Statistics over the frames of a run.
struct PeakAndMedian {
  double peak = 0.0;
  double median = 0.0;

  friend bool operator==(const PeakAndMedian&, const PeakAndMedian&) = default;
};

/// Errors of a run; empty if undefined for the scene or not reached by a failed run.
struct Errors {
  std::optional<double> trajectory_peak;         // largest distance from the reference [m]
  std::optional<double> trajectory_final;        // at the end of the reference's window [m]
  std::optional<PeakAndMedian> constraint;       // sum over joints of the 1-norm of phi [m, rad]
  std::optional<PeakAndMedian> joint_gap;        // [m]
  std::optional<PeakAndMedian> penetration;      // [m]
  double energy_drift = 0.0;                     // at the end, relative to the start [J]
  double energy_drift_peak = 0.0;                // largest magnitude [J]
  std::optional<double> energy_drift_percent;    // of the reference's energy scale, at the end
  std::optional<double> linear_momentum_drift;   // largest, without external forces [kg m/s]
  std::optional<double> angular_momentum_drift;  // about the world's origin [kg m^2/s]
  double lcp_residual = 0.0;                     // maximum over frames [N s, m/s]

  friend bool operator==(const Errors&, const Errors&) = default;
};

/// Counted cost of a run, machine-independent.
struct Work {
  std::int64_t frames = 0;
  std::int64_t substeps = 0;
  std::int64_t solves = 0;       // including the probe
  std::int64_t row_updates = 0;  // of PGS and XPBD
  std::int64_t factorisations = 0;
  std::int64_t pivots = 0;
  std::int64_t unsettled = 0;
  std::int64_t unsolved = 0;
  std::int64_t flops = 0;   // of the solver
  std::int64_t visits = 0;  // outside the solver: FrameReport::visits
  RowCounts rows;           // of all solves, by kind
  CriterionWork criterion;
  int n_min = 0;  // sub-steps of a frame
  int n_median = 0;
  int n_max = 0;

  friend bool operator==(const Work&, const Work&) = default;
};

/// Cost of a run on this machine, excluding the first frames as warm-up.
struct Timing {
  double ms_median = 0.0;         // per frame, physics only [ms]
  double ms_p95 = 0.0;            // [ms]
  double real_time_factor = 0.0;  // simulated over wall time [-]
  StageTimes stages;              // sums over the run [s]
};

struct Metrics {
  Errors errors;
  Work work;
  Timing timing;
  bool holds = true;
  double failed_at = 0.0;  // [s], of a failed run
  std::string verdict;
  std::uint64_t hash = 0;  // of the state at the end
};

/// Accumulates the metrics of a run, in memory that does not grow with its length: medians and
/// percentiles of more than BoundedSample::kMost frames are those of a sample.
class Measure {
 public:
  /// @param reference must outlive this
  Measure(const Scene& scene, const State& state, const FrameReport& start,
          const Reference& reference);

  /// @param seconds wall time of the frame
  void add(const Scene& scene, const State& state, const FrameReport& report, double seconds);
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }
  [[nodiscard]] Metrics metrics(const Scene& scene, const State& state) const;

 private:
  /// Largest value, and values for the median.
  struct Spread {
    double peak = 0.0;
    BoundedSample sample;

    void add(double value);
    [[nodiscard]] PeakAndMedian of_all() const;
  };

  [[nodiscard]] Timing timing(const Scene& scene) const;

  const Reference& reference_;
  Verdict verdict_;
  Errors errors_;
  Work work_;
  StageTimes stages_;
  double energy_at_start_ = 0.0;              // [J]
  double energy_ = 0.0;                       // [J]
  std::optional<Momenta> momentum_at_start_;  // if there are no external forces
  Spread constraint_;
  Spread joint_gap_;
  Spread penetration_;
  BoundedSample n_;
  std::vector<double> first_seconds_;  // wall time of the first frames, to warm up
  BoundedSample seconds_;              // of the others
  double wall_ = 0.0;                  // sum of the others
};

}  // namespace substep
