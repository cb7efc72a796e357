#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/model/methods.hpp"

namespace substep {

/// The poses at which Newton evaluates the directions of constraint forces, for a sub-step from q
/// to q+ after one from q- to q.
enum class Forces : std::uint8_t {
  kEnd,      // q+: implicit Euler
  kMean,     // q-, q and q+ with weights 1/4, 1/2 and 1/4: average acceleration
  kNumerov,  // weights 1/12, 10/12 and 1/12, with the change of the forces
};
/// How often the number of sub-steps is decided.
enum class Policy : std::uint8_t { kFrame, kSubstep };
/// Law of the drift correction. kAuto is soft with PGS and full with the other solvers. kExact
/// closes joints at the end of every sub-step, by repeated solves.
enum class Drift : std::uint8_t { kAuto, kFull, kSoft, kExact };
/// Which contact block enters K: the paper's (a modified ball-and-socket) or the true derivative.
enum class ContactStiffness : std::uint8_t { kPaper, kExact };
/// Friction bound mu times the normal force: on each component along fixed tangents (box), or in
/// every direction of sliding (cone).
enum class FrictionCone : std::uint8_t { kBox, kCone };
enum class Gyroscopic : std::uint8_t { kExplicit, kImplicit };
/// Contact detection: before every sub-step; once per frame with a look-ahead over the frame,
/// contacts then move with the bodies; or along the motion of every sub-step, so that nothing
/// passes through what it hits or touches what it misses (sim/swept.cpp).
enum class Detection : std::uint8_t { kSubstep, kFrame, kContinuous };

/// All parameters that may change while a scene runs. Settings{} and PaperSettings{} differ in
/// their defaults alone and convert to each other with all values kept.
template <Defaults kDefaults>
struct BasicSettings {
  static constexpr bool kPaper = kDefaults == Defaults::kPaper;

  SolverKind solver = SolverKind::kBpp;
  int iterations = 25;  // per sub-step: sweeps of PGS and XPBD, maximum of Newton steps, >= 1
  bool share_iterations = false;  // sweeps are per frame, divided among its sub-steps
  bool warm_start = false;        // PGS starts from the last sub-step's forces
  Forces forces = Forces::kEnd;   // Newton
  int refinements = 0;  // BPP: refinement solves that remove the scene's regularisation, >= 0
  int pivots = 20;      // block pivots of BPP before its method changes, >= 1

  Mode mode = Mode::kAdaptive;
  double alpha = 0.1;             // stability threshold of Eq. 5, in (0, 1] [-]; N ~ alpha^-1/2
  int n = 16;                     // sub-steps per frame in mode kConst, >= 1
  int n_max = kPaper ? 64 : 256;  // maximum sub-steps per frame in mode kAdaptive, >= 1
  int n_cap = 4;         // maximum sub-steps per frame in modes kCapped, kInertia and kBlend, >= 1
  double alpha_m = 0.7;  // kInertia, kBlend: upper bound on dt^2 k/(4 Mt), in (0, 1) [-]
  double beta = 0.95;    // kBlend: undamped share of the velocity, in [0, 1] [-]
  Policy policy = Policy::kFrame;
  double memory = 0.9;         // decay of r per sub-step in policy kSubstep, in [0, 1) [-]
  int hold = kPaper ? 1 : 60;  // N falls only after so many frames that need fewer sub-steps, >= 1
  bool redo = !kPaper;   // a frame that turns out to need more sub-steps is taken again with them
  bool islands = false;  // each island has its own N, in modes that choose N
  bool sleep = false;    // islands at rest are not stepped
  bool probe = true;     // one solve before the first frame for the forces that determine N

  Integrator integrator = kPaper ? Integrator::kEuler : Integrator::kLeapfrog;
  Gyroscopic gyroscopic = Gyroscopic::kImplicit;
  Drift drift = kPaper ? Drift::kAuto : Drift::kExact;
  double drift_tau = 1.0 / 480.0;  // time constant of the soft drift law, > 0 [s]
  int drift_order = 1;             // 2: includes the curvature of joint rows, drift.hpp
  Detection detection = kPaper ? Detection::kSubstep : Detection::kContinuous;
  ContactStiffness contact_stiffness = ContactStiffness::kPaper;
  bool rotation_criterion = true;  // N also depends on the rotation and gyroscopic rates of bodies
  FrictionCone friction_cone = kPaper ? FrictionCone::kBox : FrictionCone::kCone;
  bool watch_stiffness = false;  // evaluate K for display even if the mode does not need it

  // NOLINTNEXTLINE(google-explicit-constructor): the same settings, whatever their defaults
  template <Defaults kOther>
  requires(kOther != kDefaults) constexpr operator BasicSettings<kOther>() const {
    return __builtin_bit_cast(BasicSettings<kOther>, *this);  // libc++ 14 has no std::bit_cast
  }
  friend bool operator==(const BasicSettings&, const BasicSettings&) = default;
  template <Defaults kOther>
  requires(kOther != kDefaults) friend bool operator==(const BasicSettings& a,
                                                       const BasicSettings<kOther>& b) {
    return a == BasicSettings(b);
  }
};

using PaperSettings = BasicSettings<Defaults::kPaper>;
inline constexpr Settings kPaperSettings = PaperSettings{};

/// True if all impulses, including those of joints, are seeded with the forces of the last
/// sub-step.
inline bool starts_from_last_forces(const Settings& s) {
  return s.warm_start || entry_of(s.solver).seeded ||
         (s.solver == SolverKind::kBpp && s.refinements > 0);
}

/// True if poses are corrected for the change of acceleration (stormer.cpp). With solvers that hold
/// constraints at the end of a sub-step, bodies move by their velocities: leapfrog.
inline bool follows_accelerations(const Settings& s) {
  return s.integrator == Integrator::kStormer && !entry_of(s.solver).at_end;
}

/// The drift law, with kAuto resolved by solver. Only the direct solver closes joints exactly;
/// otherwise exact is auto.
inline Drift drift_law(const Settings& s) {
  const bool closes = s.solver == SolverKind::kBpp;
  if (s.drift != Drift::kAuto && (s.drift != Drift::kExact || closes)) return s.drift;
  return entry_of(s.solver).soft_drift ? Drift::kSoft : Drift::kFull;
}

/// True if Störmer's method sets up rows for the poses at the end of the sub-step.
inline bool aims_at_poses(const Settings& s) {
  return follows_accelerations(s) && drift_law(s) != Drift::kSoft;
}

/// True if the solver or the mode of these settings reads the given setting.
constexpr bool reads(const Settings& s, std::string_view setting) {
  const auto lists = [setting](const SettingNames& names) {
    return std::find(names.begin(), names.end(), setting) != names.end();
  };
  return lists(entry_of(s.solver).reads) || lists(entry_of(s.mode).reads);
}

}  // namespace substep
