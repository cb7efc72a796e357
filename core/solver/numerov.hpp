#pragma once

#include <span>
#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/solver/system.hpp"

namespace substep {

// Numerov's method in terms of mean velocities v over the sub-step; for tumbling bodies, I^-1 of
// the mean angular momentum. In world axes only torques change the momentum. With sub-steps dt- and
// dt on either side of a pose, and t = (dt- + dt)/2,
//   M (v+ - v) = t F + (dt^2 - dt-^2)/6 F' + (dt^3 + dt-^3)/24 F'' + O(dt^5).
// The right-hand side is t times a weighted mean of the forces at three poses: the one b behind,
// that of the start and that of the end, with b = max(dt, dt-). For equal sub-steps the weights are
// Numerov's, (1, 10, 1)/12. In the first sub-step dt- = 0.

/// Weights of the poses behind, here and ahead; their sum is 1.
struct PoseWeights {
  double behind = 0.0;
  double here = 0.0;
  double ahead = 1.0;
  double reach = 0.0;  // b, time back to the pose behind [s]

  /// Coefficient of a force's second derivative in its weighted mean:
  ///   impulse/t = lambda + bent lambda'' [s^2]. (The first derivative is given: Block::rate.)
  [[nodiscard]] double bent(double dt) const {
    return 0.5 * (behind * reach * reach + ahead * dt * dt);
  }
};

/// If a sub-step is more than 3.2 times shorter than the previous one, `ahead` is limited to -1/4
/// and F'' is not matched: a third-order error at that change.
PoseWeights numerov_weights(double dt, double dt_previous);

/// Motions and forces of the bodies in a Newton iterate.
class NumerovCourses {
 public:
  void reserve(std::size_t bodies);

  /// Initialises without constraint forces. @param u_star per body: v before any impulse
  void begin(const System& system, std::span<const Vec6> u_star);
  /// Motions under the current forces, which are then cleared: rotations follow from the torques at
  /// both ends of the sub-step (free_turn.hpp). Velocities are those passed to integrate().
  void find_turns(const System& system);
  /// Accumulates the forces of the next iterate, block by block.
  /// @param here its rows at the start, with the impulse of the iterate  @param behind, ahead the
  /// same rows moved by behind() and ahead()
  void add_forces(const System& system, const Block& here, const Block& behind, const Block& ahead);

  [[nodiscard]] const Motions& behind() const { return behind_; }
  [[nodiscard]] const Motions& ahead() const { return ahead_; }
  [[nodiscard]] PoseWeights weights_of(const System& system, const Block& block) const;

 private:
  struct Course {
    Vec6 given = Vec6::Zero();   // acceleration without constraints [m/s^2, rad/s^2]
    Vec6 behind = Vec6::Zero();  // forces of constraints, world [N, N m]
    Vec6 here = Vec6::Zero();
    Vec6 ahead = Vec6::Zero();

    void clear_forces() { behind = here = ahead = Vec6::Zero(); }
  };

  [[nodiscard]] BodyCourse course_of(const System& system, std::size_t body) const;
  std::vector<Course> courses_;
  Motions behind_;
  Motions ahead_;
};

}  // namespace substep
