#pragma once

#include <vector>

#include "core/stepping/leapfrog.hpp"

namespace substep {

/// Sub-steps around Newton with forces numerov (solver/numerov.hpp): it starts from extrapolated
/// forces and velocities, and returns the motion of the sub-step.
class Numerov : public Leapfrog {
 public:
  /// @param integrator that determines the duration of external forces
  Numerov(const Scene& scene, const JointStage* joints, Integrator integrator)
      : Leapfrog(scene), joints_(joints), as_euler_(integrator == Integrator::kEuler) {}
  [[nodiscard]] double force_time(double dt_previous, double dt) const override {
    return as_euler_ ? Euler::force_time(dt_previous, dt) : Leapfrog::force_time(dt_previous, dt);
  }
  void begin(const Substep& sub, State& state) override;
  void seed(const StoredForce& of_last, const State& state, Block& block) const override;
  void extend(System& system, const Substep& sub, const State& state) override;
  void settle(Substep& /*sub*/, State& /*state*/) override {}
  void store(const Substep& sub, const State& state, const Block& block,
             StoredForce& force) const override;
  void move_poses(const Substep& sub, State& state) override;
  void synchronise(const Substep& sub, State& state) override;

 protected:
  [[nodiscard]] double share_ahead(double dt_previous, double dt) const override {
    return as_euler_ ? Euler::share_ahead(dt_previous, dt) : Leapfrog::share_ahead(dt_previous, dt);
  }
  [[nodiscard]] bool keeps_momentum(std::size_t /*body*/) const override { return true; }

 private:
  void find_first_rates(const Substep& sub, State& state) const;

  const JointStage* joints_;
  bool as_euler_;
  std::vector<Vec6> u_guess_;
  std::vector<BodyCourse> courses_;
  std::vector<Vec3> inertia_;  // principal moments of tumbling bodies, else 0
  std::vector<Vec6> w_;
};

}  // namespace substep
