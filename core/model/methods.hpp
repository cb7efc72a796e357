#pragma once
// Every solver, mode and integrator: what it does and its texts, the one table for time stepping,
// files, window, command line, sweep and report. Size and order are those of the enum; a missing
// entry is a compile error. The functions of the tables are declared here and defined in the file
// of each solver in solver/ and of each mass in stepping/.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace substep {

/// Whose values settings have where nothing is chosen.
enum class Defaults : std::uint8_t {
  kSteady,  // of this program: no gain of energy, contacts found along the motion
  kPaper,   // of Giles and Andrews, and of scene files before version 2
};
template <Defaults kDefaults>
struct BasicSettings;
using Settings = BasicSettings<Defaults::kSteady>;
class Solver;

// Each value is described by its entry below.
enum class SolverKind : std::uint8_t { kPgs, kBpp, kXpbd, kNewton, kCount };
enum class Mode : std::uint8_t {
  kNone,
  kConst,
  kDamping,
  kAdaptive,
  kCapped,
  kStiffness,
  kInertia,
  kBlend,
  kCount
};
enum class Integrator : std::uint8_t { kEuler, kLeapfrog, kStormer, kCount };

/// Colour of a curve, by its name in themes.
enum class Tint : std::uint8_t { kBlue, kOrange, kTeal, kAmber, kPurple, kText, kDim };

/// Names of the settings that a method reads, excluding those that all methods read.
using SettingNames = std::array<std::string_view, 11>;

/// A function that an entry must state: leaving it out does not compile.
template <class F>
struct Required {
  constexpr Required(F* function) : call(function) {}
  Required(std::nullptr_t) = delete;
  F* call;
};

std::unique_ptr<Solver> make_pgs();
std::unique_ptr<Solver> make_bpp();
std::unique_ptr<Solver> make_xpbd();
std::unique_ptr<Solver> make_newton();

struct SolverEntry {
  SolverKind value;
  Required<std::unique_ptr<Solver>()> make;
  std::string_view name;  // in files, links and commands
  const char* title;      // in the window
  const char* full_name;
  const char* reference;
  const char* about;
  bool sweeps = false;      // a fixed number of times over the rows; its curves are dashed
  bool at_end = false;      // holds constraints at the end of the sub-step
  bool seeded = false;      // always starts from the forces of the last sub-step
  bool soft_drift = false;  // by default its drift correction is soft
  double work = 1.0;        // per sub-step, or per iteration if it iterates, relative to BPP
  Tint tint = Tint::kBlue;  // of its curves, if at_end; otherwise the mode's colour is used
  int iterations = 0;       // maximum offered in the window; 0: not iterative
  const char* about_iterations = "";
  SettingNames reads{};
};

/// Number of sub-steps per frame.
enum class SubstepCount : std::uint8_t {
  kOne,
  kGiven,         // Settings::n
  kStable,        // N by Eq. 11, up to n_max
  kStableCapped,  // N by Eq. 11, up to n_cap
};

/// The mass Mt of a rotation that is too stiff for a sub-step, about a principal axis [kg m^2].
/// @param M its own mass [kg m^2]  @param k its stiffness [N m/rad]  @param dt [s]
using StiffMass = double(const Settings& settings, double M, double k, double dt);
StiffMass damped_mass;
StiffMass stiffened_mass;

struct ModeEntry {
  Mode value;
  SubstepCount count = SubstepCount::kOne;
  StiffMass* mass = nullptr;    // of stiff rotations; null: their own
  bool full_stiffness = false;  // M - dt^2 K with the resisting part of K: full_stiffness.hpp
  // The share of the velocity term taken with Mt, geometric_inertia.cpp; none: Settings::beta.
  std::optional<double> beta = 0.0;
  std::string_view name;
  const char* line;   // in a few words
  const char* about;  // in a sentence or two
  const char* reference = "";
  const char* caption;          // of a picture; {n} is replaced by the setting n
  const char* takes = nullptr;  // its choice instead of N by Eq. 11; null: N by Eq. 11
  const char* then = nullptr;   // its action beyond its cap; null: none
  const char* curve;            // name of its curves
  Tint tint;
  int corners;                // of its curve markers, 0: discs
  bool beyond_paper = false;  // not one of the paper's modes
  SettingNames reads{};
};

struct IntegratorEntry {
  Integrator value;
  std::string_view name;
  const char* title;
  const char* about;
  const char* reference;
};

template <class Enum>
inline constexpr std::size_t kCountOf = static_cast<std::size_t>(Enum::kCount);

inline constexpr std::array<SolverEntry, kCountOf<SolverKind>> kSolvers{{
    {.value = SolverKind::kPgs,
     .make = make_pgs,
     .name = "pgs",
     .title = "PGS",
     .full_name = "Projected Gauss-Seidel",
     .reference = "Erleben 2013",
     .about =
         "a fixed number of sweeps over the rows of Eq. 3; sliding friction is of first order.",
     .sweeps = true,
     .soft_drift = true,
     .work = 0.15,
     .iterations = 400,
     .about_iterations = "Iterations of PGS in every sub-step.",
     .reads = {"iterations", "share_iterations", "warm_start"}},
    {.value = SolverKind::kBpp,
     .make = make_bpp,
     .name = "bpp",
     .title = "BPP",
     .full_name = "Block principal pivoting",
     .reference = "Judice and Pires 1994",
     .about = "solves the boxed problem of Eq. 3 exactly.",
     .reads = {"refinements", "pivots"}},
    {.value = SolverKind::kXpbd,
     .make = make_xpbd,
     .name = "xpbd",
     .title = "XPBD",
     .full_name = "Extended position-based dynamics",
     .reference = "Mueller et al. 2020",
     .about = "sweeps that correct poses directly, each row along its current error; of first "
              "order.",
     .sweeps = true,
     .at_end = true,
     .work = 0.3,
     .tint = Tint::kPurple,
     .iterations = 400,
     .about_iterations =
         "Sweeps in every sub-step; the authors recommend one sweep and many sub-steps.",
     .reads = {"iterations", "share_iterations"}},
    {.value = SolverKind::kNewton,
     .make = make_newton,
     .name = "newton",
     .title = "Newton",
     .full_name = "Non-smooth Newton",
     .reference = "Macklin et al. 2019, Non-smooth Newton methods",
     .about = "constraint errors vanish at the end of the sub-step; forces are evaluated at poses "
              "around it.",
     .at_end = true,
     .seeded = true,
     .work = 1.5,
     .tint = Tint::kTeal,
     .iterations = 50,
     .about_iterations = "Maximum of Newton steps per sub-step; two are usually enough.",
     .reads = {"iterations", "forces", "pivots"}},
}};

inline constexpr std::array<ModeEntry, kCountOf<Mode>> kModes{{
    {.value = Mode::kNone,
     .name = "none",
     .line = "One step per frame, no stabilisation.",
     .about = "One step per frame without stabilisation: N = 1.",
     .caption = "no sub-steps",
     .takes = "Mode none always takes 1.",
     .curve = "constant N",
     .tint = Tint::kOrange,
     .corners = 4},
    {.value = Mode::kConst,
     .count = SubstepCount::kGiven,
     .name = "const",
     .line = "The same N in every frame.",
     .about = "The same number of sub-steps in every frame, chosen by you: dt = h/N. Every frame "
              "costs as much as the worst one needs.",
     .reference = "Macklin et al. 2019, Small steps",
     .caption = "constant N {n}",
     .takes = "Mode const always takes {n}.",
     .curve = "constant N",
     .tint = Tint::kOrange,
     .corners = 4,
     .reads = {"n"}},
    {.value = Mode::kDamping,
     .mass = damped_mass,
     .name = "damping",
     .line = "One step per frame; a low α damps more.",
     .about = "One step per frame; rotations that are too stiff for it are damped implicitly: "
              "b = max(0, (h² k − 4 α M)/h), Eq. 6.",
     .reference = "Andrews et al. 2017",
     .caption = "adaptive damping, α {alpha}",
     .takes = "Mode damping takes 1 and damps rotations that are too stiff for it.",
     .curve = "damping",
     .tint = Tint::kTeal,
     .corners = 5,
     .reads = {"alpha", "probe"}},
    {.value = Mode::kAdaptive,
     .count = SubstepCount::kStable,
     .name = "adaptive",
     .line = "N ~ 1/√α: quartering α doubles N.",
     .about = "As many sub-steps as the stiffest degree of freedom needs: r = max k/M (Eq. 9), "
              "dt max = 2 √(α/r) (Eq. 10), N = h/dt max, rounded up (Eq. 11).",
     .reference = "The paper's: Giles and Andrews 2024",
     .caption = "adaptive sub-steps, α {alpha}",
     .curve = "adaptive",
     .tint = Tint::kBlue,
     .corners = 0,
     .reads = {"alpha", "n_max", "policy", "memory", "hold", "redo", "islands",
               "rotation_criterion", "probe"}},
    {.value = Mode::kCapped,
     .count = SubstepCount::kStableCapped,
     .mass = damped_mass,
     .name = "capped",
     .line = "Adaptive up to a cap, then damping.",
     .about = "Adaptive up to a cap, then damping of the remaining stiffness: the combination that "
              "the paper leaves for future work.",
     .reference = "Giles and Andrews 2024",
     .caption = "N up to {n_cap}, then damping",
     .then = "damping stabilises the rest",
     .curve = "capped + damping",
     .tint = Tint::kAmber,
     .corners = 6,
     .reads = {"alpha", "n_cap", "policy", "memory", "hold", "redo", "islands",
               "rotation_criterion", "probe"}},
    {.value = Mode::kStiffness,
     .full_stiffness = true,
     .name = "stiffness",
     .line = "One step per frame, K in the mass.",
     .about = "One step per frame with the geometric stiffness itself in the mass: M - h² K, its "
              "stabilising part. Damps more than damping does.",
     .reference = "Tournier et al. 2015",
     .caption = "full geometric stiffness",
     .takes = "Mode stiffness takes 1: K in the mass resists rotations that are too stiff for it.",
     .curve = "full geometric stiffness",
     .tint = Tint::kDim,
     .corners = 4,
     .beyond_paper = true,
     .reads = {"probe"}},
    {.value = Mode::kInertia,
     .count = SubstepCount::kStableCapped,
     .mass = stiffened_mass,
     .beta = 1.0,
     .name = "inertia",
     .line = "Adaptive up to a cap, then inertia.",
     .about = "Adaptive up to a cap; beyond it rotations that are too stiff have a larger inertia, "
              "dt² k/(4 αm), which neither adds nor removes energy.",
     .reference = "This project's",
     .caption = "N up to {n_cap}, then geometric inertia",
     .then = "geometric inertia stabilises the rest",
     .curve = "capped + geometric inertia",
     .tint = Tint::kText,
     .corners = 3,
     .beyond_paper = true,
     .reads = {"alpha", "n_cap", "alpha_m", "policy", "memory", "hold", "redo", "islands",
               "rotation_criterion", "probe"}},
    {.value = Mode::kBlend,
     .count = SubstepCount::kStableCapped,
     .mass = stiffened_mass,
     .beta = std::nullopt,
     .name = "blend",
     .line = "Adaptive up to a cap, then both.",
     .about = "Adaptive up to a cap, then geometric inertia of which a share 1 - β damps: more "
              "stable where contacts open and close.",
     .reference = "This project's",
     .caption = "N up to {n_cap}, then inertia and damping",
     .then = "inertia and damping stabilise the rest",
     .curve = "capped + blend",
     .tint = Tint::kPurple,
     .corners = 6,
     .beyond_paper = true,
     .reads = {"alpha", "n_cap", "alpha_m", "beta", "policy", "memory", "hold", "redo", "islands",
               "rotation_criterion", "probe"}},
}};

inline constexpr std::array<IntegratorEntry, kCountOf<Integrator>> kIntegrators{{
    {Integrator::kEuler, "euler", "Euler",
     "Semi-implicit Euler: first order, loses energy when N changes.",
     "The paper's: Giles and Andrews 2024"},
    {Integrator::kLeapfrog, "leapfrog", "leapfrog",
     "External forces act over the mean of the previous and the current dt: second order at the "
     "same cost.",
     "Verlet 1967"},
    {Integrator::kStormer, "stormer", "Störmer",
     "Leapfrog with poses corrected for the change of acceleration, and joints that hold at the "
     "end of the sub-step: fourth order with one solve, second with contacts, while dt² k < 2 M.",
     "Störmer 1907"},
}};

template <class Entry, std::size_t N>
constexpr bool is_complete(const std::array<Entry, N>& table) {
  for (std::size_t i = 0; i < N; ++i) {
    if (static_cast<std::size_t>(table[i].value) != i || table[i].name.empty()) return false;
  }
  return true;
}
static_assert(is_complete(kSolvers) && is_complete(kModes) && is_complete(kIntegrators),
              "one entry for each, in the order of the enum");

constexpr const SolverEntry& entry_of(SolverKind solver) {
  return kSolvers[static_cast<std::size_t>(solver)];
}
constexpr const ModeEntry& entry_of(Mode mode) { return kModes[static_cast<std::size_t>(mode)]; }
constexpr const IntegratorEntry& entry_of(Integrator integrator) {
  return kIntegrators[static_cast<std::size_t>(integrator)];
}

/// True if the mode replaces the mass of rotations that are too stiff.
constexpr bool changes_mass(Mode mode) {
  return entry_of(mode).mass != nullptr || entry_of(mode).full_stiffness;
}

/// All solvers in table order: first those of Eq. 3, each group from exact to approximate.
consteval std::array<SolverKind, kSolvers.size()> listed_solvers() {
  std::array<SolverKind, kSolvers.size()> list{};
  std::size_t count = 0;
  for (const bool at_end : {false, true}) {
    for (std::size_t i = kSolvers.size(); i-- > 0;) {
      if (kSolvers[i].at_end == at_end) list[count++] = kSolvers[i].value;
    }
  }
  return list;
}

}  // namespace substep
