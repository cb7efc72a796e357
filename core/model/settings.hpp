#pragma once

#include <cstdint>

namespace substep {

/// What they are is in methods.hpp.
enum class SolverKind : std::uint8_t { kPgs, kBpp, kXpbd, kNewton, kCount };
/// How a step is kept stable (the stabilisation mode).
enum class Mode : std::uint8_t {
  kNone,       // one sub-step
  kConst,      // n of them
  kDamping,    // one, and adaptive damping (Eq. 6)
  kAdaptive,   // N by Eq. 11
  kCapped,     // N by Eq. 11 up to n_cap, and damping for what they do not reach
  kStiffness,  // one, and full geometric stiffness
  kInertia,    // N by Eq. 11 up to n_cap, and geometric inertia for what they do not reach
  kBlend,      // the same, with some damping
  kCount
};
/// The poses that Newton takes the directions of constraint forces from, over a sub-step from q to
/// q+ that follows one from q- to q.
enum class Forces : std::uint8_t {
  kEnd,      // q+: implicit Euler
  kMean,     // q-, q and q+ by 1/4, 1/2 and 1/4: average acceleration
  kNumerov,  // by 1/12, 10/12 and 1/12, with what the forces gain on the way
};
/// How often the number of sub-steps is decided.
enum class Policy : std::uint8_t { kFrame, kSubstep };
/// Semi-implicit, the paper's; of second order (Verlet 1967); of fourth, for joints (stormer.hpp).
enum class Integrator : std::uint8_t { kEuler, kLeapfrog, kStormer, kCount };
/// Law of the drift correction. kAuto is soft with PGS and full with the other solvers.
enum class Drift : std::uint8_t { kAuto, kFull, kSoft };
/// Which contact block enters K: the paper's (a modified ball-and-socket) or the true derivative.
enum class ContactStiffness : std::uint8_t { kPaper, kExact };
/// Bounds of the friction force: each tangent up to mu times the normal force, or its length.
enum class FrictionCone : std::uint8_t { kBox, kCone };
enum class Gyroscopic : std::uint8_t { kExplicit, kImplicit };
/// When contacts are looked for: before every sub-step, or once a frame, as far ahead as bodies can
/// come in it; then they are carried along with the bodies.
enum class Detection : std::uint8_t { kSubstep, kFrame };

/// Everything a person changes while a scene runs. The defaults are the paper's.
struct Settings {
  SolverKind solver = SolverKind::kBpp;
  int iterations = 25;            // per sub-step: sweeps of PGS and XPBD, most Newton steps, >= 1
  bool share_iterations = false;  // sweeps are those of a frame, shared by its sub-steps
  bool warm_start = false;        // PGS starts from the last sub-step's forces
  Forces forces = Forces::kEnd;   // Newton
  int refinements = 0;            // BPP: solves that take the scene's regularisation back, >= 0
  int pivots = 20;  // block pivoting steps of BPP before its single-pivot fallback, >= 1

  Mode mode = Mode::kAdaptive;
  double alpha = 0.1;    // stability threshold of Eq. 5, in (0, 1] [-]; N goes with alpha^-1/2
  int n = 16;            // sub-steps per frame in mode kConst, >= 1
  int n_max = 64;        // most sub-steps per frame in mode kAdaptive, >= 1
  int n_cap = 4;         // most sub-steps per frame in modes kCapped, kInertia and kBlend, >= 1
  double alpha_m = 0.7;  // kInertia, kBlend: dt^2 k/(4 Mt) is kept below it, in (0, 1) [-]
  double beta = 0.95;    // kBlend: share of the velocity that nothing damps, in [0, 1] [-]
  Policy policy = Policy::kFrame;
  double memory = 0.9;   // decay of r from sub-step to sub-step in policy kSubstep, in [0, 1) [-]
  bool islands = false;  // each island has its own N, in modes that choose it
  bool sleep = false;    // islands at rest are not stepped, and stand still
  bool probe = true;     // one solve before the first frame for the forces that N needs

  Integrator integrator = Integrator::kEuler;
  Gyroscopic gyroscopic = Gyroscopic::kImplicit;
  Drift drift = Drift::kAuto;
  double drift_tau = 1.0 / 480.0;  // time constant of the soft drift law, > 0 [s]
  int drift_order = 1;  // 2: the correction also sees how the joints' rows curve, drift.hpp
  Detection detection = Detection::kSubstep;
  ContactStiffness contact_stiffness = ContactStiffness::kPaper;
  bool rotation_criterion = true;  // N also follows the turn and the gyroscopic rate of bodies
  FrictionCone friction_cone = FrictionCone::kBox;
  bool watch_stiffness = false;  // evaluate K even where the mode does not need it, for a view

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// Whether impulses are seeded with the forces of the last sub-step, those of joints too.
inline bool starts_from_last_forces(const Settings& s) {
  return s.warm_start || s.solver == SolverKind::kNewton ||
         (s.solver == SolverKind::kBpp && s.refinements > 0);
}

/// Whether a sub-step begins with forces and velocities that go on as they changed before, and
/// carries means over it (numerov.hpp).
inline bool extrapolates(const Settings& s) {
  return s.solver == SolverKind::kNewton && s.forces == Forces::kNumerov;
}

/// Whether poses take in how accelerations change (stormer.hpp). Solvers that look at the end of a
/// sub-step move bodies by their velocities: with them it is leapfrog.
inline bool follows_accelerations(const Settings& s) {
  return s.integrator == Integrator::kStormer && s.solver != SolverKind::kNewton &&
         s.solver != SolverKind::kXpbd;
}

/// Whether bodies carry angular momentum through a sub-step and turn by free_turn.hpp.
inline bool carries_momentum(const Settings& s) {
  return follows_accelerations(s) || extrapolates(s);
}

/// kAuto resolved: the law that the solver is used with.
inline Drift drift_law(const Settings& s) {
  if (s.drift != Drift::kAuto) return s.drift;
  return s.solver == SolverKind::kPgs ? Drift::kSoft : Drift::kFull;
}

}  // namespace substep
