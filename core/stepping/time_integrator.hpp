#pragma once

#include <cstdint>
#include <memory>

#include "core/constraints/joint_stage.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/stepping/substep.hpp"

namespace substep {

/// A method that advances velocities and poses, one class for each. Its functions are called in
/// this order in a sub-step. Those with a default are for methods that need more than Eq. 3.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;

  /// Duration of applied forces [s]. @param dt_previous 0 at the start [s]
  [[nodiscard]] virtual double force_time(double dt_previous, double dt) const = 0;
  /// Sets state.u to the velocity that the forces of the sub-step act on.
  virtual void begin(const Substep& sub, State& state) = 0;
  /// Forgets the impacts of an earlier solve of the sub-step.
  virtual void begin_solve(const Substep& /*sub*/) {}
  /// A body's angular velocity at the start of the sub-step: Substep::u_before may be of its
  /// middle.
  [[nodiscard]] virtual Vec3 spin_at_start(const Substep& sub, std::size_t body) const {
    return sub.u_before[body].tail<3>();
  }
  /// Velocities before the forces of the sub-step whose mean with those after its solve is that of
  /// the start.
  [[nodiscard]] virtual std::span<const Vec6> velocities_at_start(const Substep& sub) const {
    return sub.u_start;
  }
  /// Takes it after impacts. @return that of Substep::u_before
  virtual Vec3 strike(const Substep& /*sub*/, std::size_t /*body*/, const Vec3& spin_at_start) {
    return spin_at_start;
  }
  /// Keeps the impacts taken so far: the bodies of the part were struck at the start of the
  /// sub-step.
  virtual void keep_strikes(const Substep& /*sub*/) {}
  /// True if a sub-step may start from velocities at the time of the poses, as the first one does.
  [[nodiscard]] virtual bool starts_at_poses() const = 0;
  /// Forgets the accelerations of a body that was struck.
  virtual void forget(std::size_t /*body*/, State& /*state*/) const {}
  /// Continues the force that seeds a block.
  virtual void seed(const StoredForce& /*of_last*/, const State& /*state*/,
                    Block& /*block*/) const {}
  /// Changes rows that must hold at other poses than Eq. 3 implies. @return operations
  virtual std::int64_t aim(const Substep& sub, State& state) = 0;
  /// Adds the data of solvers that compute more than velocities.
  virtual void extend(System& /*system*/, const Substep& /*sub*/, const State& /*state*/) {}
  /// True if accelerations must not be extrapolated across the force of this contact. A resolved
  /// spring causes no impact.
  [[nodiscard]] virtual bool breaks_motion(const Block& contact) const;
  /// The velocities with which move_poses() will move the bodies after this solve.
  /// @param w out, per moving body [m/s, rad/s]
  virtual void predict_velocities(const Substep& sub, const State& state,
                                  std::span<Vec6> w) const = 0;
  /// The change of these velocities by a change of state.u along a row, relative to that change.
  [[nodiscard]] virtual double motion_gain(const Substep& /*sub*/, const State& /*state*/,
                                           const Block& /*block*/) const {
    return 1.0;
  }
  /// False if poses may move otherwise, so that joints cannot be closed on that motion.
  [[nodiscard]] virtual bool knows_motion(const Substep& /*sub*/) const { return true; }
  /// Completes the velocities after the solve.
  virtual void settle(Substep& sub, State& state) = 0;
  /// Adds rates to a force that is stored for the next sub-step.
  virtual void store(const Substep& /*sub*/, const State& /*state*/, const Block& /*block*/,
                     StoredForce& /*force*/) const {}
  /// Advances the poses.
  virtual void move_poses(const Substep& sub, State& state) = 0;
  /// Sets state.u_synchronised: stored velocities are half a sub-step older than the poses.
  virtual void synchronise(const Substep& sub, State& state) = 0;
};

/// The method that the settings select. @param joints null without joints; both outlive the method
std::unique_ptr<TimeIntegrator> make_integrator(const Scene& scene, const JointStage* joints,
                                                const Settings& settings);
std::unique_ptr<TimeIntegrator> make_stormer(const Scene& scene, const JointStage* joints);
std::unique_ptr<TimeIntegrator> make_numerov(const Scene& scene, const JointStage* joints,
                                             Integrator integrator);

}  // namespace substep
