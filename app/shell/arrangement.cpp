#include "app/shell/arrangement.hpp"

#include <algorithm>
#include <string>

#include "app/app.hpp"
#include "app/text/link.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

constexpr const char* kKey = "arrangement";

std::string text_of(const App& app) {
  const Desk& d = app.desk;
  std::string text = "left=" + number_text(static_cast<double>(d.left.width)) +
                     "&right=" + number_text(static_cast<double>(d.right.width)) +
                     "&left_open=" + (d.left.open ? "1" : "0") +
                     "&right_open=" + (d.right.open ? "1" : "0") +
                     "&scale=" + number_text(d.scale) + "&tour=" + (d.tour_hint ? "new" : "seen") +
                     "&level=" + (d.level == DeskLevel::kLab ? "lab" : "explore") +
                     "&views=" + (d.split ? "split" : "ghosts") + "&plots=";
  for (const ui::PlotState& plot : d.plots) {
    text += plot.shown ? 's' : 'h';
    text += plot.logarithmic ? 'g' : 'n';
  }
  return text;
}

void take(Desk& d, const LinkPart& part) {
  const auto number = parse_number(part.value);
  const auto width = [&](PanelSide& side) {
    if (number) side.width = static_cast<float>(std::clamp(*number, 0.0, 1000.0));
  };
  if (part.key == "left") width(d.left);
  if (part.key == "right") width(d.right);
  if (part.key == "left_open") d.left.open = part.value != "0";
  if (part.key == "right_open") d.right.open = part.value != "0";
  if (part.key == "scale" && number) d.scale = std::clamp(*number, 0.8, 1.5);
  if (part.key == "tour") d.tour_hint = part.value != "seen";
  if (part.key == "level") d.level = part.value == "lab" ? DeskLevel::kLab : DeskLevel::kExplore;
  if (part.key == "views") d.split = part.value == "split";
  if (part.key == "plots" && part.value.size() == 2 * d.plots.size()) {
    for (std::size_t i = 0; i < d.plots.size(); ++i) {
      d.plots[i].shown = part.value[2 * i] == 's';
      d.plots[i].logarithmic = part.value[2 * i + 1] == 'g';
    }
  }
}

}  // namespace

void recall_arrangement(App& app) {
  if (!app.host.recall) return;
  app.desk.tour_hint = true;  // by default it is a first visit
  app.desk.level = DeskLevel::kExplore;
  for (const LinkPart& part : parse_link(app.host.recall(kKey))) take(app.desk, part);
  app.last_arrangement = text_of(app);
}

void remember_arrangement(App& app) {
  // Not during a drag: a width changes with every pixel.
  // Nor while the tour controls the window.
  if (!app.host.remember || ImGui::IsAnyMouseDown() || app.desk.tour >= 0) return;
  std::string text = text_of(app);
  if (text == app.last_arrangement) return;
  app.last_arrangement = std::move(text);
  app.host.remember(kKey, app.last_arrangement);
}

}  // namespace substep
