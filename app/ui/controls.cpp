// The left panel: which scene, and how it is solved.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/names.hpp"

namespace substep::ui {
namespace {

constexpr std::array<Choice, 5> kModes{
    {{"none", "One step per frame and nothing against instability: N = 1."},
     {"const",
      "The same number of sub-steps in every frame, chosen by you: dt = h/N "
      "(Macklin et al. 2019). Every frame pays for the worst one."},
     {"damping",
      "One step per frame; rotations that are too stiff for it are damped implicitly: "
      "b = max(0, (h² k − 4 α M)/h), Eq. 6 (Andrews et al. 2017)."},
     {"adaptive",
      "As many sub-steps as the stiffest degree of freedom needs: "
      "r = max k/M (Eq. 9), dt max = 2 √(α/r) (Eq. 10), N = h/dt max, rounded up "
      "(Eq. 11)."},
     {"capped",
      "Adaptive up to a cap, damping for what is left over: the combination that the "
      "paper leaves for future work."}}};

constexpr std::array<const char*, 5> kModeLines{
    "One step a frame, unprotected.", "The same N in every frame.",
    "One step a frame; less α, more damping.", "N ~ 1/√α: a quarter of α, twice the N.",
    "Adaptive up to a cap, then damping."};

constexpr std::array<Choice, 2> kSolvers{
    {{"PGS", "Projected Gauss-Seidel: a fixed number of sweeps over the rows of Eq. 3."},
     {"BPP", "Block principal pivoting: solves the boxed problem of Eq. 3 exactly."}}};
constexpr std::array<Choice, 2> kIntegrators{
    {{"Euler", "Semi-implicit Euler, the paper's: first order, loses energy when N changes."},
     {"leapfrog", "External forces act over (dt before + dt)/2: second order at the same cost."}}};
constexpr std::array<Choice, 2> kPolicies{
    {{"frame", "N is decided once a frame, from the forces of its last sub-step: the paper's."},
     {"sub-step", "dt is decided again after every sub-step, with a decaying memory of r."}}};
constexpr std::array<Choice, 3> kDrifts{
    {{"auto", "Full with BPP, soft with PGS."},
     {"full", "The whole error is taken back in one step: bias phi/dt."},
     {"soft",
      "The error decays with a time constant of its own: bias phi dt/tau², so that a "
      "change of dt brings no energy in."}}};

template <class Enum, std::size_t N>
bool choose(const Look& look, const char* name, const std::array<Choice, N>& choices, Enum& value,
            const char* tip) {
  int index = static_cast<int>(value);
  const bool changed = segmented_row(look, name, choices, index, tip);
  value = static_cast<Enum>(index);
  return changed;
}

void scene_picker(App& app) {
  const Look& look = app.look;
  const Scene& now = app.session.scene();
  section(look, "Scene");
  const float width = ImGui::GetContentRegionAvail().x;
  std::shared_ptr<const Scene> chosen;
  menu_button(look, "scene", now.title.c_str(), width, look.m.row + 4.0F, "", [&] {
    const std::string* group = nullptr;
    for (const auto& scene : app.library.scenes()) {
      if (group == nullptr || *group != scene->group) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float top = group == nullptr ? 4.0F : 10.0F;
        draw_text(*ImGui::GetWindowDrawList(), look.fonts.small, {at.x + 8.0F, at.y + top},
                  look.theme->dim, group_title(scene->group).c_str());
        ImGui::Dummy({1.0F, top + 18.0F});
        group = &scene->group;
      }
      const bool current = scene->name == now.name;
      if (menu_item(look, scene->title.c_str(), "", current)) chosen = scene;
    }
  });
  label(look.fonts.small, look.theme->dim,
        now.look_for.empty() ? now.description.c_str() : now.look_for.c_str());
  if (chosen) app.run(chosen);
}

void stabilisation(const Look& look, Settings& s) {
  const Mode mode = s.mode;
  section(look, "Stabilisation");
  int index = static_cast<int>(mode);
  segmented(look, "mode", kModes, index, ImGui::GetContentRegionAvail().x);
  s.mode = static_cast<Mode>(index);
  label(look.fonts.small, look.theme->dim, kModeLines[static_cast<std::size_t>(index)]);

  if (s.mode == Mode::kDamping || s.mode == Mode::kAdaptive || s.mode == Mode::kCapped) {
    slider(look, "Alpha  α", s.alpha, 0.005, 1.0, true, "%.3g",
           "Stability threshold of Eq. 5: 1 is the limit itself, less keeps a distance from it. "
           "N goes with 1/√α (Eq. 10): a quarter of alpha doubles N.");
  }
  if (s.mode == Mode::kConst) {
    slider(look, "N", s.n, 1, 128, true, "Sub-steps in every frame: dt = h/N.");
  } else if (s.mode == Mode::kAdaptive) {
    slider(look, "N at most", s.n_max, 1, 512, true,
           "An impact or a start that does not fit asks for thousands: this many are given.");
  } else if (s.mode == Mode::kCapped) {
    slider(look, "N cap", s.n_cap, 1, 64, true,
           "Sub-steps up to here; damping (Eq. 6) at dt = h/N cap for what they do not reach.");
  }
  if (s.mode == Mode::kAdaptive || s.mode == Mode::kCapped) {
    choose(look, "N decided", kPolicies, s.policy, "How often N is decided (Eq. 11).");
  }
}

void solving(const Look& look, Settings& s) {
  section(look, "Solver");
  choose(look, "Method", kSolvers, s.solver, "What solves the velocities of a sub-step, Eq. 3.");
  if (s.solver == SolverKind::kPgs) {
    slider(look, "Sweeps", s.iterations, 1, 400, true, "Iterations of PGS in every sub-step.");
  } else {
    slider(look, "Pivots", s.pivots, 1, 100, true,
           "Block pivots of BPP before it goes on one by one, which always ends.");
  }
  choose(look, "Integrator", kIntegrators, s.integrator, "How a sub-step advances time.");
  choose(look, "Drift", kDrifts, s.drift, "How errors of position are taken back.");
  if (s.solver == SolverKind::kPgs) {
    checkbox(look, "warm start", s.warm_start, ImGui::GetContentRegionAvail().x,
             "Sweeps start from the forces of the last sub-step.");
  }
}

void showing(App& app) {
  const Look& look = app.look;
  ViewOptions& v = app.desk.view;
  section(look, "Show");
  const float half = 0.5F * ImGui::GetContentRegionAvail().x;
  checkbox(look, "why this N", v.tint, half,
           "Bodies by their k/M: the orange ones ask for small steps. Evaluates K in every mode.");
  ImGui::SameLine(0.0F, 0.0F);
  checkbox(look, "joints", v.joints, half, "Pins where bodies are joined.");
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 4.0F);
  checkbox(look, "trail", v.trail, half, "Path of the body that the scene tracks.");
  ImGui::SameLine(0.0F, 0.0F);
  checkbox(look, "masses", v.labels, half, "Mass of what is heavy.");
}

}  // namespace

void method_controls(const Look& look, Settings& settings) {
  stabilisation(look, settings);
  space(look.m.section);
  solving(look, settings);
}

void controls(App& app) {
  const Look& look = app.look;
  Settings s = app.session.settings();
  scene_picker(app);
  // The picker may have brought a scene with settings of its own.
  if (app.session.settings() != s) s = app.session.settings();
  space(look.m.section);
  method_controls(look, s);
  space(look.m.section);
  showing(app);
  if (s != app.session.settings()) app.change(s);
}

}  // namespace substep::ui
