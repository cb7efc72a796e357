#pragma once

#include <optional>
#include <vector>

#include "core/stepping/substep.hpp"

namespace substep {

// Tumbling of bodies with unequal moments of inertia: torques change their angular momentum, which
// determines their rotation (math/gyroscopic.hpp, free_turn.hpp).

/// True if a body rotates differently from what torques alone give.
bool turns_otherwise(const Substep& sub, std::size_t body);

/// True if in addition its angular momentum is conserved.
bool tumbles(const Substep& sub, std::size_t body);

/// Gives every body a stored torque, zero if it has none.
void resize_torques(State& state);

/// The gyroscopic torque of first- and second-order methods.
///
/// The solver assumes M u+ = M u* + J^T impulse, while the angular momentum p at the start of the
/// sub-step obeys p + J^T impulse = I u+ - dt/2 (I u+) x u+. The gyroscopic term on the right is
/// predicted with the torque of the previous sub-step; settle() then solves for u+ with the exact
/// momentum. The correction is O(dt^3); the joint error of the same order is removed by the drift
/// correction. No torque is predicted if a mode replaces the mass, if Newton uses forces at the end
/// of the sub-step, or if the rotation is large: these cases are first order anyway.
class GyroscopicStage {
 public:
  /// Adds the torque to state.u before the forces.
  void begin(const Substep& sub, State& state);
  /// False if another method carries the momentum.
  [[nodiscard]] bool predicts() const { return !spins_.empty(); }
  /// TimeIntegrator's, if it predicts(), for a body that tumbles().
  void begin_solve(const Substep& sub);
  [[nodiscard]] Vec3 spin_at_start(const Substep& sub, std::size_t body) const;
  Vec3 strike(const Substep& sub, std::size_t body, const Vec3& spin_at_start);
  void keep_strikes(const Substep& sub);
  /// Sets up ("bends") rows of joints for the predicted rotation of their bodies.
  void bend_rows(const Substep& sub) const;
  /// The angular velocity that settle() will set. @param omega after the solve, world [rad/s]
  [[nodiscard]] Vec3 settled(const Substep& sub, std::size_t body, const Vec3& omega) const;
  /// Solves for the angular velocity with the exact momentum, after the solve.
  void settle(Substep& sub, State& state) const;
  /// True if begin() found that a body does not rotate about a principal axis, and its momentum is
  /// kept.
  [[nodiscard]] bool keeps_momentum(std::size_t body) const {
    return spins_[body].out_of_axis && !spins_[body].damped;
  }

 private:
  struct Spin {                     // about the principal axes
    Vec3 momentum = Vec3::Zero();   // at the start of the sub-step [N m s]
    Vec3 struck = Vec3::Zero();     // its change by impacts [N m s]
    Vec3 push = Vec3::Zero();       // expected from forces [N m s]
    Vec3 predicted = Vec3::Zero();  // dt/2 of the gyroscopic torque in it [N m s]
    Vec3 omega = Vec3::Zero();      // predicted, world [rad/s]
    Vec3 before = Vec3::Zero();     // before forces and rows, after impacts, world [rad/s]
    Vec3 unstruck = Vec3::Zero();   // before impacts too, world [rad/s]
    bool out_of_axis = false;       // false: it rotates about a principal axis
    bool bends = false;             // rows of its joints are set up at its predicted pose
    bool damped = false;            // its momentum is not kept
  };
  void predict(const Substep& sub, std::size_t body, bool damps, State& state);
  /// Sets the angular velocity before forces from the momentum. @param guess of that with them
  void aim(const Substep& sub, std::size_t body, const Vec3& guess);
  /// Angular impulse of forces and rows about the principal axes [N m s], if the momentum
  /// determines the rotation. @param omega after the solve, world [rad/s]
  [[nodiscard]] std::optional<Vec3> pushed(const Substep& sub, std::size_t body,
                                           const Vec3& omega) const;
  [[nodiscard]] Vec3 settled(const Substep& sub, std::size_t body, const Vec3& omega,
                             const Vec3& pushed) const;

  std::vector<Spin> spins_;  // per body, of what tumbles
  bool loops_bend_ = false;  // the rows of all joints are bent in this sub-step
};

}  // namespace substep
