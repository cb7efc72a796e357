#pragma once

#include <optional>
#include <vector>

#include "core/stepping/gyroscopic_stage.hpp"
#include "core/stepping/time_integrator.hpp"

namespace substep {

/// Semi-implicit Euler, the paper's: u+ from Eq. 3, then poses with u+.
class Euler : public TimeIntegrator {
 public:
  explicit Euler(const Scene& scene);
  [[nodiscard]] double force_time(double /*dt_previous*/, double dt) const override { return dt; }
  void begin(const Substep& sub, State& state) override {
    if (gyroscopic_) gyroscopic_->begin(sub, state);
  }
  void begin_solve(const Substep& sub) override;
  [[nodiscard]] bool starts_at_poses() const override { return false; }
  [[nodiscard]] Vec3 spin_at_start(const Substep& sub, std::size_t body) const override;
  Vec3 strike(const Substep& sub, std::size_t body, const Vec3& spin_at_start) override;
  void keep_strikes(const Substep& sub) override;
  std::int64_t aim(const Substep& sub, State& state) override;
  void predict_velocities(const Substep& sub, const State& state, std::span<Vec6> w) const override;
  void settle(Substep& sub, State& state) override {
    if (gyroscopic_) gyroscopic_->settle(sub, state);
  }
  void move_poses(const Substep& sub, State& state) override;
  void synchronise(const Substep& sub, State& state) override;

 protected:
  /// The share of the last change of velocity that is missing at the end of the sub-step.
  [[nodiscard]] virtual double share_ahead(double dt_previous, double dt) const {
    return dt / ((dt_previous == 0.0 ? dt : dt_previous) + dt);
  }
  /// True if a tumbling body keeps its angular momentum in this sub-step.
  [[nodiscard]] virtual bool keeps_momentum(std::size_t body) const {
    return gyroscopic_->keeps_momentum(body);
  }

 private:
  [[nodiscard]] bool strikes_spin(const Substep& sub, std::size_t body) const;
  void find_hit(const Substep& sub);
  void turn_joint_forces(const Substep& sub, const State& state);
  void resist_by_armatures(const Substep& sub);
  void synchronise_spin(const Substep& sub, std::size_t body, double ahead, const Vec3& bent,
                        State& state) const;

  std::optional<GyroscopicStage> gyroscopic_;  // if the scene has the effect
  std::vector<std::uint8_t> hit_;              // per body: an impact of this sub-step reached it
  std::vector<Vec6> bent_push_;  // change of the joints' impulses as bodies move [N s, N m s]
  struct Resisting {             // armatures of a body's joints, on its motion [kg, kg m^2]
    Mat3 linear = Mat3::Zero();
    Mat3 angular = Mat3::Zero();
    bool any = false;
  };
  std::vector<Resisting> resisting_;
};

}  // namespace substep
