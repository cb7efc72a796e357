// Explore's controls: method, load, comparison and a ball.

#include <array>
#include <cmath>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/methods.hpp"

namespace substep::ui {
namespace {

// A name on the left and a menu of a table's entries on the right.
template <class Entries, class Value, class Title, class Note>
void menu_row(const Look& look, const char* name, const Entries& entries, Value& value, Title title,
              Note note, const char* tip) {
  constexpr float kName = 104.0F;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float line = text_size(look.fonts.regular, name).y;
  draw_text(look.fonts.regular, {origin.x, origin.y + 0.5F * (look.m.row + 2.0F - line)},
            look.theme->dim, name);
  ImGui::SetCursorScreenPos({origin.x + kName, origin.y});
  const std::string current(entries[static_cast<std::size_t>(value)].*title);
  menu_button(look, name, current, width - kName, look.m.row + 2.0F, tip, [&] {
    for (const auto& entry : entries) {
      if (menu_item(look, std::string(entry.*title), entry.*note, entry.value == value)) {
        value = entry.value;
      }
    }
  });
}

void parameters(const Look& look, Settings& s) {
  if (reads(s, "alpha")) {
    slider(look, "Alpha  α", s.alpha, 0.005, 1.0, true, "%.3g",
           "Relative to the stability limit, which is 1 (Eq. 5). N is proportional to 1/√α "
           "(Eq. 10): quartering alpha doubles N.");
  }
  if (reads(s, "n")) slider(look, "N", s.n, 1, 128, true, "Sub-steps in every frame: dt = h/N.");
  if (reads(s, "n_cap")) {
    slider(look, "N cap", s.n_cap, 1, 64, true,
           "Maximum of sub-steps; the mode damps the remaining stiffness.");
  }
}

void method(const Look& look, Settings& s) {
  section(look, "Method");
  menu_row(look, "Stabilisation", kModes, s.mode, &ModeEntry::name, &ModeEntry::line,
           "Stabilisation of the run (1 to 8)");
  menu_row(look, "Solver", kSolvers, s.solver, &SolverEntry::title, &SolverEntry::full_name,
           "Solver for the velocities of a sub-step, Eq. 3");
  label(look.fonts.small, look.theme->dim, entry_of(s.mode).line);
  parameters(look, s);
}

// Rounds to 1, 1.5, 2, 3, 5 or 7 per decade, so that a drag does not restart the run at every
// pixel.
double rounded_load(double load) {
  constexpr std::array<double, 7> kSteps{1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0};
  const double decade = std::pow(10.0, std::floor(std::log10(load) + 1e-9));
  double nearest = kSteps[0];
  for (const double step : kSteps) {
    if (std::abs(std::log(load / decade / step)) < std::abs(std::log(load / decade / nearest))) {
      nearest = step;
    }
  }
  return nearest * decade;
}

void load_row(const Look& look, Lab& lab) {
  section(look, "Load", (grouped(lab.heaviest_mass()) + " kg"));
  double load = lab.load;
  if (!power_slider(look, "Factor  ×", load, 0.01, 100.0,
                    "Factor on the mass of the heaviest body: the mass ratio. The run "
                    "restarts.")) {
    return;
  }
  load = rounded_load(load);
  if (std::abs(load - lab.load) > 1e-9 * load) lab.vary(load, lab.seed);
}

void comparison(const Look& look, Lab& lab, Desk& desk) {
  section(look, "Compare");
  const float width = ImGui::GetContentRegionAvail().x;
  if (!lab.compare.open()) {
    compare_menu(look, lab.session, lab.compare, "With another method", width);
    if (!lab.compare.open()) return;
    lab.reset();  // restart both
    lab.session.play();
    return;
  }
  checkbox(look, "Side by side", desk.split,
           "Each in its own view, or the other one as a ghost (V)");
  if (button(look, "end", Icon::kNone, "End the comparison", ButtonKind::kPlain, width, look.m.row,
             "")) {
    lab.compare.close();
  }
}

}  // namespace

void explore_controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  Settings s = lab.session.settings();
  method(look, s);
  if (s != lab.session.settings()) lab.change(s);
  space(look.m.section);
  load_row(look, lab);
  space(look.m.section);
  comparison(look, lab, desk);
  space(look.m.section);
  if (!lab.compare.open()) find_n_button(look, lab, desk);  // fewer than 20 controls
  if (button(look, "throw", Icon::kBall, "Throw a ball", ButtonKind::kPlain,
             ImGui::GetContentRegionAvail().x, look.m.row + 2.0F,
             "From the camera; B throws it at the pointer")) {
    throw_ball(lab, viewport);
  }
}

}  // namespace substep::ui
