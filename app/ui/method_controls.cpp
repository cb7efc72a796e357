// Mode and solver with their parameters, from the table of methods.

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/lab/presets.hpp"
#include "core/model/methods.hpp"

namespace substep::ui {
namespace {

constexpr std::array<Choice, 3> kForces{
    {{"end", "The end of the sub-step: implicit Euler, which damps (Macklin et al. 2019)."},
     {"mean",
      "Before, at and after it by 1/4, 1/2, 1/4: average acceleration (Newmark 1959), stable for "
      "any step, without loss."},
     {"Numerov",
      "By 1/12, 10/12, 1/12 and with the rate of the forces (after Numerov 1924): fourth order "
      "with two steps, for scenes of joints, while dt² k < 6 M. With soft joints in space, and for "
      "the forces of joints, second order."}}};
constexpr std::array<Choice, 2> kPolicies{
    {{"frame",
      "N is decided once per frame, from the forces of its last sub-step: the paper's (Giles and "
      "Andrews 2024)."},
     {"sub-step",
      "dt is decided again after every sub-step, with a decaying memory of r. Our addition."}}};
constexpr std::array<Choice, 4> kDrifts{
    {{"auto", "Soft with PGS, full with the others."},
     {"full", "The whole error is corrected in one step: bias phi/dt (Baumgarte 1972)."},
     {"soft",
      "The error decays with its own time constant: bias phi dt/tau², so that a change of dt adds "
      "no energy. Our addition."},
     {"exact",
      "Joints hold at the end of every sub-step, by repeated solves (SHAKE, Ryckaert et al. 1977): "
      "no correction stays in the velocities. BPP with Euler or leapfrog; others are full."}}};

constexpr std::array<Choice, 2> kContactStiffnesses{
    {{"paper",
      "The contact as a ball joint with the same force: the paper's (Giles and Andrews 2024), "
      "determines N."},
     {"exact", "The true derivative of the contact force, friction included. Our addition."}}};
constexpr std::array<Choice, 2> kFrictionCones{
    {{"box",
      "The paper's: up to μ times the normal force along each tangent, and up to 1.41 μ between "
      "the tangents."},
     {"cone",
      "Isotropic Coulomb friction: up to μ times the normal force against sliding in every "
      "direction."}}};
constexpr std::array<Choice, 3> kDetections{
    {{"sub-step", "Detected before every sub-step."},
     {"frame",
      "Detected once per frame, as far ahead as bodies can travel, and moved with them (Macklin et "
      "al. 2019, Small steps). Fast bodies do not pass through, but changes of features within the "
      "frame are detected late."},
     {"continuous",
      "Found along the motion of every sub-step: nothing passes through what it hits or touches "
      "what it misses. Rebounds begin where and when bodies meet; overlaps are parted without "
      "speed."}}};
constexpr std::array<Choice, 2> kGyroscopics{
    {{"explicit", "Explicit Euler, as in most engines: gains energy."},
     {"implicit",
      "Half a step explicit, half implicit: conserves energy and angular momentum. Our "
      "addition."}}};

std::string about(const SolverEntry& e) {
  return std::string(e.full_name) + " (" + e.reference + "): " + e.about;
}

template <class Entry>
std::string about(const Entry& e) {
  return *e.reference == '\0' ? e.about : std::string(e.about) + " " + e.reference + ".";
}

const char* title(const ModeEntry& e) { return e.name.data(); }
template <class Entry>
const char* title(const Entry& e) {
  return e.title;
}

// The entries of a table of methods, as choices of a row.
class MethodChoices {
 public:
  template <class Entries>
  explicit MethodChoices(const Entries& entries) {
    tips_.reserve(std::size(entries));
    for (const auto& entry : entries) {
      tips_.push_back(about(entry));
      choices_.push_back({title(entry), tips_.back().c_str()});
    }
  }
  operator std::span<const Choice>() const { return choices_; }

 private:
  std::vector<std::string> tips_;
  std::vector<Choice> choices_;
};

// Presets of all settings, over the whole width: four do not fit beside a label.
void preset_row(const Look& look, const Scene& scene, Settings& s) {
  const std::vector<Preset> presets = presets_for(scene);
  std::vector<Choice> choices;
  int current = -1;  // custom settings
  for (const Preset& preset : presets) {
    Settings same = preset.settings;
    same.watch_stiffness = s.watch_stiffness;
    if (same == s) current = static_cast<int>(choices.size());
    choices.push_back({preset.name.data(), preset.about.c_str()});
  }
  if (segmented(look, "Preset", choices, current, ImGui::GetContentRegionAvail().x)) {
    const bool watched = s.watch_stiffness;
    s = presets[static_cast<std::size_t>(current)].settings;
    s.watch_stiffness = watched;
  }
}

// The paper's modes, and the others below them.
void mode_rows(const Look& look, Mode& mode) {
  const std::span<const ModeEntry> all = kModes;
  const auto beyond = std::find_if(all.begin(), all.end(),
                                   [](const ModeEntry& entry) { return entry.beyond_paper; });
  const std::span<const ModeEntry> paper(all.begin(), beyond);
  const std::span<const ModeEntry> further(beyond, all.end());
  const auto first = static_cast<int>(paper.size());
  const float width = ImGui::GetContentRegionAvail().x;
  int index = static_cast<int>(mode);
  segmented(look, "mode", MethodChoices(paper), index, width);
  int in_further = index - first;
  if (segmented(look, "further mode", MethodChoices(further), in_further, width)) {
    index = first + in_further;
  }
  mode = static_cast<Mode>(index);
}

void stabilisation(const Look& look, const Scene& scene, Settings& s) {
  section(look, "Stabilisation");
  preset_row(look, scene, s);
  mode_rows(look, s.mode);
  label(look.fonts.small, look.theme->dim, entry_of(s.mode).line);

  if (reads(s, "alpha")) {
    slider(look, "Alpha  α", s.alpha, 0.005, 1.0, true, "%.3g",
           "Stability threshold of Eq. 5: 1 is the limit, smaller values keep a distance from it. "
           "N is proportional to 1/√α (Eq. 10): quartering alpha doubles N.");
  }
  if (reads(s, "n")) {
    slider(look, "N", s.n, 1, 128, true, "Sub-steps in every frame: dt = h/N.");
  }
  if (reads(s, "n_max")) {
    slider(
        look, "Max sub-steps", s.n_max, 1, 512, true,
        "Maximum of sub-steps per frame: an impact or an inconsistent start would need thousands.");
  }
  if (reads(s, "n_cap")) {
    slider(look, "N cap", s.n_cap, 1, 64, true,
           "Maximum of sub-steps; at dt = h/N cap the mode stabilises the remaining stiffness.");
  }
  if (reads(s, "alpha_m")) {
    slider(look, "Alpha m", s.alpha_m, 0.1, 0.99, false, "%.2f",
           "Distance of the larger inertia from the stability limit: forces may grow by 1/αm from "
           "one sub-step to the next. Smaller is safer and less accurate.");
  }
  if (reads(s, "beta")) {
    slider(look, "Beta  β", s.beta, 0.0, 1.0, false, "%.3f",
           "Share of the velocity that is not damped: 1 is geometric inertia, 0 is damping.");
  }
}

void solving(const Look& look, const Scene& scene, Settings& s) {
  section(look, "Solver");
  choose(look, "Method", MethodChoices(kSolvers), s.solver,
         "Solver for the velocities of a sub-step, Eq. 3.");
  const SolverEntry& solver = entry_of(s.solver);
  if (reads(s, "forces")) {
    choose(look, "Forces", kForces, s.forces,
           "Poses at which the constraint forces are evaluated.");
  }
  if (reads(s, "iterations")) {
    slider(look, solver.sweeps ? "Sweeps" : "Steps", s.iterations, 1, solver.iterations, true,
           solver.about_iterations);
  }
  if (reads(s, "refinements") && scene.regularisation > 0.0) {
    slider(look, "Refine", s.refinements, 0, 32, false,
           "Additional solves that remove the effect of the scene's regularisation, starting from "
           "the last forces: the proximal point method (Rockafellar 1976). Each costs a solve with "
           "the existing factor.");
  }
  if (reads(s, "share_iterations")) {
    checkbox(look, "Sweeps of a frame", s.share_iterations,
             "The sweeps are per frame and distributed over its sub-steps: small steps (Macklin et "
             "al. 2019, Small steps).");
  }
  choose(look, "Integrator", MethodChoices(kIntegrators), s.integrator,
         "How a sub-step advances time.");
  if (s.integrator == Integrator::kStormer && !follows_accelerations(s)) {
    label(look.fonts.small, look.theme->dim, "Newton and XPBD use leapfrog instead.");
  }
}

// The rule for N.
void finer_points_of_mode(const Look& look, Settings& s) {
  if (reads(s, "policy")) {
    choose(look, "Choose N every", kPolicies, s.policy, "How often N is decided (Eq. 11).");
    if (s.policy == Policy::kSubstep) {
      slider(look, "Memory", s.memory, 0.0, 0.99, false, "%.2f",
             "Share of r (Eq. 9) that is kept from one sub-step to the next: a force that dips for "
             "one sub-step does not lengthen the next one.");
    }
    slider(look, "Hold N", s.hold, 1, 240, true,
           "Frames that must need fewer sub-steps before their number falls: an N that follows the "
           "motion up and down changes its energy. Our addition.");
    checkbox(look, "Take frames again", s.redo,
             "A frame that turns out to need more sub-steps is taken again with them. Our "
             "addition.");
  }
  if (reads(s, "rotation_criterion")) {
    checkbox(look, "Rotation criterion", s.rotation_criterion,
             "N also depends on the rotation and the gyroscopic rate of bodies. Off: the paper's "
             "rule only.");
  }
  if (reads(s, "islands")) {
    checkbox(look, "Per-island sub-steps", s.islands,
             "Groups of bodies that neither joints nor possible contacts connect within a frame "
             "have their own number of sub-steps: groups that need few take few. Our addition.");
  }
  checkbox(look, "Sleep resting bodies", s.sleep,
           "Bodies sleep at no cost when everything connected with them has been slower than 1 "
           "cm/s for half a second. They wake when a body comes near.");
  if (reads(s, "probe")) {
    checkbox(look, "Probe before the first frame", s.probe,
             "One solve of a whole frame, not integrated, computes the forces that Eq. 9 needs; "
             "without it the first N is 1. Takes effect on reset.");
  }
}

// Advanced settings; only those effective with this scene, mode and solver.
void finer_points(const Look& look, const Effects& effects, Settings& s) {
  finer_points_of_mode(look, s);
  if (effects.contact) {
    choose(look, "Contacts", kDetections, s.detection, "When contacts are detected.");
    choose(look, "K contact", kContactStiffnesses, s.contact_stiffness,
           "Block of a contact in K (Eq. 1).");
  }
  if (effects.friction) {
    choose(look, "Friction", kFrictionCones, s.friction_cone, "Bounds of the friction force.");
  }
  choose(look, "Drift", kDrifts, s.drift, "Law of the correction of position errors.");
  if (drift_law(s) == Drift::kSoft) {
    double tau_ms = 1e3 * s.drift_tau;
    if (slider(look, "Drift τ", tau_ms, 0.2, 50.0, true, "%.2f ms",
               "Time constant of the soft law: bias phi dt/tau² for dt below tau.")) {
      s.drift_tau = 1e-3 * tau_ms;
    }
  }
  // Joints that hold at the end of the sub-step need no correction: exact ones, and Störmer's.
  const bool aimed = drift_law(s) == Drift::kExact || aims_at_poses(s);
  if (effects.joints && !aimed) {
    bool second = s.drift_order == 2;
    checkbox(look, "Correct for curvature", second,
             "Second order: joints are also corrected for the error that their rotation will cause "
             "by the end of the sub-step, dt²/2 phi''. Half the error with exact joints, noise "
             "with soft ones. Our addition.");
    s.drift_order = second ? 2 : 1;
  }
  if (reads(s, "warm_start")) {
    checkbox(look, "Warm start", s.warm_start,
             "Sweeps start from the forces of the previous sub-step.");
  }
  if (reads(s, "pivots") && effects.contact) {
    slider(look, "Pivots", s.pivots, 1, 100, true,
           "Block pivots of BPP (Judice and Pires 1994) before its method changes: to an "
           "interior-point method, or to pivots of single rows.");
  }
  if (effects.gyroscopic) {
    choose(look, "Gyroscopic", kGyroscopics, s.gyroscopic, "How the torque I ω × ω is integrated.");
  }
}

}  // namespace

void method_controls(const Look& look, const Scene& scene, Settings& settings, bool& more) {
  stabilisation(look, scene, settings);
  space(look.m.section);
  solving(look, scene, settings);
  fold(look, more ? "Less" : "More", more,
       "Rarely needed settings: drift, the probe, how often N is decided, contacts in K.");
  if (more) finer_points(look, scene.effects, settings);
}

}  // namespace substep::ui
