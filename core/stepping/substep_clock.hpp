#pragma once

#include "core/model/settings.hpp"

namespace substep {

/// dt_max = 2 sqrt(alpha / r), Eq. 10. @param r [1/s^2] @return [s], infinite for r = 0
double stable_step(double alpha, double r);

/// Whether N follows from r.
bool chooses_substeps(Mode mode);

/// Whether that is decided after every sub-step.
bool decides_again(const Settings& settings);

/// Whether islands have sub-steps of their own.
bool has_islands(const Settings& settings);

/// Whether islands are looked for: they have sub-steps of their own, or may fall asleep.
bool looks_for_islands(const Settings& settings);

/// N = ceil(h / dt_max), Eq. 11, at least 1.
int wanted_substeps(double h, double dt_max);

/// What is known of r after a sub-step: policy `substep` keeps what was before, fading.
/// @param now, before [1/s^2]
double remembered(const Settings& settings, double now, double before);

/// Deals out one frame of length h in sub-steps.
///   none, damping, stiffness    one sub-step
///   const                       n
///   adaptive                    N by Eq. 11 from r, at most n_max; decided once (policy frame) or
///                               again after every sub-step, with r decaying by `memory` (policy
///                               substep)
///   capped, inertia, blend      the same, at most n_cap
class SubstepClock {
 public:
  /// @param r largest k_i/M_ii known at the start of the frame [1/s^2]
  /// @param r_rotation the rotation criterion's, which stands beside it [1/s^2]
  SubstepClock(const Settings& settings, double h, double r, double r_rotation = 0.0);

  [[nodiscard]] bool running() const { return left_ > 0; }
  [[nodiscard]] double dt() const { return dt_; }   ///< [s]
  [[nodiscard]] int left() const { return left_; }  ///< sub-steps to come, as decided so far
  [[nodiscard]] int taken() const { return taken_; }
  /// Whether what follows reads the stiffness of this sub-step.
  [[nodiscard]] bool needs_stiffness() const;
  /// Goes on to the next sub-step. @param r of this sub-step, where it was needed [1/s^2]
  /// @param r_rotation of its end, where N is decided again [1/s^2]
  void advance(double r, double r_rotation = 0.0);

  /// What the next frame, or sub-step, goes by, of the stiffness alone [1/s^2].
  [[nodiscard]] double r() const { return r_; }
  [[nodiscard]] int n_wanted() const { return n_wanted_; }
  [[nodiscard]] bool capped() const { return capped_; }

 private:
  void decide();

  Settings settings_;
  double h_;
  double rest_;  // not yet dealt out [s]
  double r_;
  double r_rotation_;
  double dt_ = 0.0;
  int limit_ = 1;  // most sub-steps per frame
  int left_ = 1;   // sub-steps in rest_ at the present decision
  int taken_ = 0;  // sub-steps of this frame
  int n_wanted_ = 1;
  bool capped_ = false;
};

}  // namespace substep
