#pragma once

#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/stepping/leapfrog.hpp"

namespace substep {

// Störmer's fourth-order method (1907), one solve per sub-step:
//   q+ - 2 q + q- = dt^2/12 (14 a - 5 a- + 4 a-- - a---).
// It is leapfrog, u+ = u + dt a, with poses corrected for the change of acceleration: with
// D = a - a-,
//   q+ = q + dt w,   w = u+ + dt/12 (2 D - D-).
// On the model of Eq. 5 it is stable while dt^2 k < 2 M, and damps motion near that limit. The
// constraints must hold at q+. With a = (u+ - u)/t (t: duration of forces, dt) w is linear in u+:
//   w = g u+ + known terms,   g = 1 + dt/(6 t),
// and the rows, linearised about the poses q^ extrapolated with the last change of acceleration,
// w^ = w(u^), become
//   phi(q^)/dt + J (w - w^) = 0,   or   J u+ - J u^ + phi(q^)/(g dt) = 0.
// If dt differs from the previous dt-, the changes are scaled (D and D- by dt/dt-, hence
// g = 1 + dt/dt- dt/(6 t)), and the dt^2 term omitted from the velocities is corrected:
//   u = q' - dt^2/24 a'  in the middle of a sub-step, so that  u += (dt^2 - dt-^2)/12 a'.
// Rotations do not commute: by Magnus' expansion a body with changing angular velocity rotates by
// dt w + dt^3/12 w' x w in world axes. (For tumbling bodies see free_turn.hpp.) The Cayley vector
// of integrate() is dt w/2; that of a rotation by dt |w| is longer by a relative (dt |w|/2)^2/3.

/// Needs solvers that hold the rows as they are given. In sub-steps with an impact, which is not an
/// acceleration, it is leapfrog.
class Stormer : public Leapfrog {
 public:
  Stormer(const Scene& scene, const JointStage* joints) : Leapfrog(scene), joints_(joints) {}
  void begin(const Substep& sub, State& state) override;
  std::int64_t aim(const Substep& sub, State& state) override;
  /// The change of acceleration is unknown when a contact with a resolved spring opens or closes.
  [[nodiscard]] bool breaks_motion(const Block& contact) const override;
  void settle(Substep& sub, State& state) override;
  void move_poses(const Substep& sub, State& state) override;
  void synchronise(const Substep& sub, State& state) override;

 protected:
  [[nodiscard]] bool keeps_momentum(std::size_t /*body*/) const override { return true; }

 private:
  void find_first_changes(const Substep& sub, State& state) const;
  void aim_at_poses(const Substep& sub, State& state);
  void store_changes(const Substep& sub, std::size_t body, const Vec6& a, State& state);

  const JointStage* joints_;
  std::vector<Vec6> u_guess_;  // u^
  Motions motions_;            // by w^
  std::vector<Vec6> w_;
  struct Changes {  // per body, over dt; of the torque for tumbling bodies
    Vec6 a = Vec6::Zero();
    Vec6 now = Vec6::Zero();
    Vec6 before = Vec6::Zero();
  };
  std::vector<Changes> changes_;
};

}  // namespace substep
