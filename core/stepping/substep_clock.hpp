#pragma once

#include "core/model/settings.hpp"

namespace substep {

/// The body and degree of freedom with the largest k/M. body = -1 if K is zero.
struct StiffnessLeader {
  int body = -1;
  int dof = 0;        // 0..2 linear, 3..5 about the body's principal axes
  double k = 0.0;     // K_d,i [N/m or N m/rad]
  double mass = 0.0;  // M_ii [kg or kg m^2]
  double r = 0.0;     // k / mass, Eq. 9 [1/s^2]
};

/// dt_max = 2 sqrt(alpha / r), Eq. 10. @param r [1/s^2] @return [s], infinite for r = 0
double stable_step(double alpha, double r);

/// True if N is determined by r.
bool chooses_substeps(Mode mode);

/// True if the r of every sub-step is needed: N is held, or a frame may be taken again.
bool watches_substeps(const Settings& settings);

/// True if N is re-evaluated after every sub-step.
bool decides_again(const Settings& settings);

/// True if each island has its own sub-steps.
bool has_islands(const Settings& settings);

/// True if islands are detected: for their own sub-steps, or for sleeping.
bool looks_for_islands(const Settings& settings);

/// N = ceil(h / dt_max), Eq. 11, at least 1.
int wanted_substeps(double h, double dt_max);

/// r after a sub-step: `now`, but with policy `substep` at least Settings::memory times `before`.
/// @param now, before [1/s^2]
double remembered(const Settings& settings, double now, double before);

/// Divides one frame of length h into sub-steps.
///   none, damping, stiffness    one sub-step
///   const                       n
///   adaptive                    N by Eq. 11 from r, at most n_max; decided once (policy frame) or
///                               again after every sub-step, with r decaying by `memory` (policy
///                               substep)
///   capped, inertia, blend      the same, at most n_cap
class SubstepClock {
 public:
  /// @param r largest k_i/M_ii at the start of the frame [1/s^2]
  /// @param r_rotation bound of the rotation criterion [1/s^2]
  /// @param r_least held throughout the frame [1/s^2]
  SubstepClock(const Settings& settings, double h, double r, double r_rotation = 0.0,
               double r_least = 0.0);

  [[nodiscard]] bool running() const { return left_ > 0; }
  [[nodiscard]] double dt() const { return dt_; }   ///< [s]
  [[nodiscard]] int left() const { return left_; }  ///< remaining sub-steps, as currently planned
  [[nodiscard]] int taken() const { return taken_; }
  /// True if the sub-step may be shortened, which happens at most max(few, N/4) times in a frame.
  [[nodiscard]] bool may_shorten(int few) const;
  /// The longest length that was planned since the first impact of the frame [s].
  [[nodiscard]] double planned_dt() const { return planned_; }
  /// Ends the sub-step after dt; equal sub-steps fill the rest of the frame. May be called again to
  /// correct dt. @param dt less than the length of the sub-step before the first call [s]
  void shorten(double dt);
  /// True if the stiffness of this sub-step is needed later.
  [[nodiscard]] bool needs_stiffness() const;
  /// Advances to the next sub-step. @param r of this sub-step, if needed [1/s^2]
  /// @param r_rotation at its end, if N is re-evaluated [1/s^2]
  void advance(double r, double r_rotation = 0.0);

  /// r for the next frame or sub-step, from the stiffness alone [1/s^2].
  [[nodiscard]] double r() const { return r_; }
  [[nodiscard]] int n_wanted() const { return n_wanted_; }
  [[nodiscard]] bool capped() const { return capped_; }
  /// True if a sub-step was longer than its own r allows, and more sub-steps are possible.
  [[nodiscard]] bool exceeded() const { return exceeded_ && !capped_; }

 private:
  void decide();

  Settings settings_;
  double h_;
  double rest_;  // from the start of the sub-step, or of equal ones, to the end of the frame [s]
  double r_;
  double r_rotation_;
  double r_least_;
  double dt_ = 0.0;
  int left_ = 1;           // sub-steps planned for rest_
  int taken_ = 0;          // sub-steps taken in this frame
  int shortened_ = 0;      // how many of them
  bool shortens_ = false;  // this one
  double planned_ = 0.0;   // the longest planned [s]
  int n_wanted_ = 1;
  bool capped_ = false;
  bool exceeded_ = false;
};

}  // namespace substep
