#pragma once

#include <span>
#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/solver/system.hpp"

namespace substep {

// Numerov's method as sub-steps that carry mean velocities v, of what tumbles I^-1 of the mean of
// its angular momentum over the sub-step. In the world the momentum changes by torques alone, so
// that with sub-steps dt- and dt on both sides of a pose, and t = (dt- + dt)/2,
//   M (v+ - v) = t F + (dt^2 - dt-^2)/6 F' + (dt^3 + dt-^3)/24 F'' + O(dt^5).
// The right-hand side is t times a weighted mean of the forces at three poses: the one b behind,
// that of the start and that of the end, with b = max(dt, dt-). For equal sub-steps the weights are
// Numerov's, (1, 10, 1)/12. Without a sub-step before, dt- = 0, they are those of a start.

/// Weights of the poses behind, here and ahead; their sum is 1.
struct PoseWeights {
  double behind = 0.0;
  double here = 0.0;
  double ahead = 1.0;
  double reach = 0.0;  // b, how far the pose behind is [s]

  /// What the mean of a force has beside the one here, as a share of its second derivative:
  ///   impulse/t = lambda + bent lambda'' [s^2]. (The first derivative is given: Block::rate.)
  [[nodiscard]] double bent(double dt) const {
    return 0.5 * (behind * reach * reach + ahead * dt * dt);
  }
};

/// Where a sub-step is more than 3.2 times shorter than the one before, `ahead` stays at -1/4 and
/// F'' is not met: an error of third order in such a change.
PoseWeights numerov_weights(double dt, double dt_previous);

/// Where bodies go in a Newton iterate, and by which forces.
class NumerovCourses {
 public:
  void reserve(std::size_t bodies);

  /// Forces of no constraint yet. @param u_star per body: v before any impulse
  void begin(const System& system, std::span<const Vec6> u_star);
  /// How bodies move by the forces found so far: a turn follows from the torques at both ends of
  /// the sub-step (free_turn.hpp). Velocities are those that integrate() moves by.
  void find_turns(const System& system);
  /// Clears the forces; add_forces() of every block adds them up again.
  void clear_forces();
  /// @param here its rows at the start, with the impulse of the iterate  @param behind, ahead the
  /// same rows moved by motion_behind() and motion_ahead()
  void add_forces(const System& system, const Block& here, const Block& behind, const Block& ahead);

  [[nodiscard]] const Motion& motion_behind(int body) const;
  [[nodiscard]] const Motion& motion_ahead(int body) const;
  [[nodiscard]] PoseWeights weights_of(const System& system, const Block& block) const;

 private:
  struct Course {
    Vec6 given = Vec6::Zero();   // acceleration without constraints [m/s^2, rad/s^2]
    Vec6 behind = Vec6::Zero();  // forces of constraints, world [N, N m]
    Vec6 here = Vec6::Zero();
    Vec6 ahead = Vec6::Zero();
    Motion motion_behind;
    Motion motion_ahead;
  };

  [[nodiscard]] BodyCourse course_of(const System& system, std::size_t body) const;
  std::vector<Course> courses_;
  Motion none_;
};

}  // namespace substep
