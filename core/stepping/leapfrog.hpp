#pragma once

#include "core/stepping/euler.hpp"
#include "core/stepping/rolling.hpp"

namespace substep {

/// Leapfrog, second order (Verlet 1967): Euler with applied forces from the middle of the last
/// sub-step to the middle of this one. dt_previous = 0 at the start.
class Leapfrog : public Euler {
 public:
  explicit Leapfrog(const Scene& scene) : Euler(scene) { motions_.resize(scene.bodies.size()); }
  [[nodiscard]] double force_time(double dt_previous, double dt) const override {
    return 0.5 * (dt_previous + dt);
  }

  std::int64_t aim(const Substep& sub, State& state) override {
    return Euler::aim(sub, state) + aim_rolling(sub, motions_);
  }
  [[nodiscard]] bool starts_at_poses() const override { return true; }

 protected:
  [[nodiscard]] double share_ahead(double dt_previous, double dt) const override {
    return dt / (dt_previous + dt);
  }

  Motions motions_;  // scratch of aim()
};

}  // namespace substep
