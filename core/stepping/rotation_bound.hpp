#pragma once

#include <span>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

// Eq. 9 accounts for geometric stiffness alone. A freely spinning top has none, so Eq. 11 gives
// N = 1 however fast it spins. The rotation criterion adds three rates to r, all bounded by the
// same Eq. 10, dt <= 2 sqrt(alpha/r):
//   the rotation, r = (kTurnShare |omega|)^2, so that a sub-step rotates a body by at most
//   2 sqrt(alpha)/kTurnShare (0.2 rad at alpha = 0.1, the limit of torque prediction);
//   for pendulums, the rotation of the arm from the joint to the centre,
//   r = (kArmShare |omega x arm|/|arm|)^2: 0.08 rad at alpha = 0.1. The energy error of leapfrog,
//   relative to the energy that a pendulum exchanges, is an eighth of the square of that angle:
//   0.8e-3;
//   the gyroscopic rate of Euler's equations linearised about omega,
//   rate^2 = sum_i omega_i^2 |(I_i - I_j)(I_i - I_k)|/(I_j I_k), at which a disturbance of the axis
//   oscillates (or grows), at most |omega| for the moments of any solid.
//
// A pendulum stops twice per period. If N followed, each change of N would leave an energy error,
// first order with Euler and second with leapfrog, and these accumulate: thin boxes swinging for
// two minutes lose 30 to 70 % of their energy with Euler and 1.1 to 1.3 % with leapfrog. Pendulum
// rates are therefore the maximum of the last 4 to 8 s (kRotationWindow). A pendulum is a body on a
// single joint, to the world or a static body, in a scene without contacts. In chains N varies with
// the stiffness, and impacts change the energy, so such a memory would have no benefit.

inline constexpr double kTurnShare = 3.2;
inline constexpr double kArmShare = 8.0;
inline constexpr double kRotationWindow = 4.0;  // [s]

/// The body of a part with the largest rotation rate.
struct RotationBound {
  double r = 0.0;  // [1/s^2]
  int body = -1;   // -1 if nothing rotates
};

/// Covers bodies on joints and bodies with unequal moments of inertia.
class RotationCriterion {
 public:
  explicit RotationCriterion(const Scene& scene);
  /// The fastest of the given bodies, including the memory in `state`.
  [[nodiscard]] RotationBound bound(const Scene& scene, std::span<const int> bodies,
                                    const State& state) const;
  /// Stores the pendulum rates at the start of a frame in `state`.
  void remember(const Scene& scene, State& state) const;

 private:
  struct Pendulum {
    int body = -1;
    Vec3 arm = Vec3::Zero();  // unit vector to its joint, body axes; 0 if at its centre
  };
  /// @param joints their number, per moving body
  void find_pendulums(const Scene& scene, std::span<const int> joints);

  std::vector<std::uint8_t> counts_;  // per body
  std::vector<Pendulum> pendulums_;
};

}  // namespace substep
