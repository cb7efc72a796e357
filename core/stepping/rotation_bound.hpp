#pragma once

#include <span>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

// Eq. 9 looks at the geometric stiffness alone, and a top that spins freely has none: by it a body
// that turns by a radian a sub-step takes one. The rotation criterion puts three rates beside r,
// all bounded by the same Eq. 10, dt <= 2 sqrt(alpha/r):
//   the turn itself, r = (kTurnShare |omega|)^2, so that a sub-step turns a body by no more than
//   2 sqrt(alpha)/kTurnShare (0.2 rad at alpha = 0.1, up to which torques are predicted);
//   of pendulums, the turn of the arm from the joint to the centre, r = (kArmShare |omega x
//   arm|/|arm|)^2: 0.08 rad at alpha = 0.1. The energy of leapfrog errs by an eighth of the square
//   of that turn, of what a pendulum exchanges: by 0.8e-3;
//   the gyroscopic rate of Euler's equations linearised about omega,
//   rate^2 = sum_i omega_i^2 |(I_i - I_j)(I_i - I_k)|/(I_j I_k), at which a disturbance of the axis
//   swings (or grows), at most |omega| for the moments of any solid.
//
// A pendulum stands still twice in a period. Where N follows that, each change of N leaves an error
// of the energy, first order with Euler and second with leapfrog, and they add up: thin boxes that
// swing for two minutes lose 30 to 70 % of their energy with Euler and 1.1 to 1.3 % with leapfrog.
// So rates of pendulums have a memory: the largest of the last 4 to 8 s count (kRotationWindow).
// A pendulum is a body on one joint, which holds it to what is static, in a scene without contacts.
// Along chains N changes with the stiffness, and impacts change the energy: a memory of rotation
// would gain nothing there.

inline constexpr double kTurnShare = 3.2;
inline constexpr double kArmShare = 8.0;
inline constexpr double kRotationWindow = 4.0;  // [s]

/// The body of a part that rotates fastest by this measure.
struct RotationBound {
  double r = 0.0;  // [1/s^2]
  int body = -1;   // -1 where nothing rotates
};

/// Of bodies whose turn bends something: on joints, or with moments of inertia that differ.
class RotationCriterion {
 public:
  explicit RotationCriterion(const Scene& scene);
  /// The fastest of some bodies, now and as far as `state` remembers.
  [[nodiscard]] RotationBound bound(const Scene& scene, std::span<const int> bodies,
                                    const State& state) const;
  /// Takes the rates of pendulums at the start of a frame into the memory of `state`.
  void remember(const Scene& scene, State& state) const;

 private:
  struct Pendulum {
    int body = -1;
    Vec3 arm = Vec3::Zero();  // to its joint, unit vector in its own axes; 0 at its centre
  };
  void find_pendulums(const Scene& scene);

  std::vector<std::uint8_t> counts_;  // per body
  std::vector<Pendulum> pendulums_;
};

}  // namespace substep
