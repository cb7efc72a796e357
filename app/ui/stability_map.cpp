#include "app/ui/stability_map.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kMapGutter = 44.0F;  // the values of the parameter
constexpr float kCell = 22.0F;       // height
constexpr float kCellGap = 2.0F;     // between cells
constexpr float kWidest = 96.0F;     // of a cell

/// The cells of one mode.
struct Grid {
  Settings settings;           // of any of its runs
  std::vector<double> values;  // of the parameter, from careless to careful
  std::vector<double> loads;   // rising
  std::map<std::pair<double, double>, std::size_t> results;  // by value and load
};

void add_once(std::vector<double>& list, double value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// The modes that are planned under other loads, with the results so far.
std::vector<Grid> grids_of(const Accuracy& accuracy) {
  std::vector<std::pair<std::string, Grid>> named;
  const auto grid = [&](const Settings& s) -> Grid* {
    const std::string name = series_name(s);
    for (auto& [known, found] : named) {
      if (known == name) return &found;
    }
    return nullptr;
  };
  for (const Experiment& e : accuracy.experiments()) {
    if (e.load == 1.0) continue;
    if (grid(e.settings) == nullptr) {
      named.push_back({series_name(e.settings), {e.settings, {}, {1.0}, {}}});
    }
    Grid& own = *grid(e.settings);
    add_once(own.values, series_parameter(e.settings).value);
    add_once(own.loads, e.load);
  }
  for (std::size_t i = 0; i < accuracy.results().size(); ++i) {
    const Experiment& e = accuracy.results()[i].experiment;
    if (Grid* own = grid(e.settings)) {
      own->results[{series_parameter(e.settings).value, e.load}] = i;
    }
  }
  std::vector<Grid> grids;
  for (auto& [name, own] : named) {
    std::sort(own.values.begin(), own.values.end());
    if (own.settings.mode != Mode::kConst) std::reverse(own.values.begin(), own.values.end());
    std::sort(own.loads.begin(), own.loads.end());
    grids.push_back(std::move(own));
  }
  return grids;
}

/// "320", "3.2k": a cell is narrow.
std::string short_ratio(double ratio) {
  return ratio < 1e3 ? plain_number(ratio) : plain_number(1e-3 * ratio) + "k";
}

ImU32 cell_color(const Theme& t, const Result& result) {
  if (result.metrics.holds) return fade(t.blue, t.dark ? 0.55F : 0.3F);
  const auto survived = static_cast<float>(result.metrics.failed_at / result.experiment.duration);
  return fade(t.orange, (t.dark ? 0.65F : 0.5F) - 0.35F * std::min(1.0F, survived));
}

void read_cell(const Look& look, const Result& result, double ratio) {
  const SeriesParameter parameter = series_parameter(result.experiment.settings);
  const Theme& t = *look.theme;
  const std::string name = curve_style(t, result.experiment.settings).name() + ", " +
                           parameter.name + " = " + plain_number(parameter.value);
  read_out(look, std::vector<ReadOutLine>{{name, t.text, true},
                                          {"mass ratio " + plain_number(ratio), t.dim},
                                          {verdict_words(result.metrics.verdict),
                                           result.metrics.holds ? t.dim : t.orange},
                                          {"Click to run it", t.accent}});
}

std::optional<std::size_t> draw_grid(const Look& look, const Accuracy& accuracy, const Grid& grid,
                                     float width) {
  const Theme& t = *look.theme;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const auto rows = static_cast<float>(grid.values.size());
  const auto columns = static_cast<float>(grid.loads.size());
  const float cell = std::min(kWidest, (width - kMapGutter) / columns);
  const ImVec2 size(kMapGutter + cell * columns, kCell * rows + 18.0F);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const std::string name = series_name(grid.settings);
  const bool clicked = ImGui::InvisibleButton(name.c_str(), size);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool hovered = ImGui::IsItemHovered();
  const double ratio = mass_ratio(*accuracy.scene());
  const auto centred = [&](ImVec2 from, float across, ImU32 color, const std::string& text) {
    const ImVec2 extent = text_size(look.fonts.small, text.c_str());
    draw_text(draw, look.fonts.small,
              {from.x + 0.5F * (across - extent.x), from.y + 0.5F * (kCell - extent.y)}, color,
              text.c_str());
  };
  std::optional<std::size_t> under;
  for (std::size_t row = 0; row < grid.values.size(); ++row) {
    const float y = origin.y + kCell * static_cast<float>(row);
    const std::string value = plain_number(grid.values[row]);
    const ImVec2 extent = text_size(look.fonts.small, value.c_str());
    draw_text(draw, look.fonts.small,
              {origin.x + kMapGutter - 8.0F - extent.x, y + 0.5F * (kCell - extent.y)}, t.dim,
              value.c_str());
    for (std::size_t column = 0; column < grid.loads.size(); ++column) {
      const ImVec2 min(origin.x + kMapGutter + cell * static_cast<float>(column), y);
      const ImVec2 max(min.x + cell - kCellGap, min.y + kCell - kCellGap);
      const auto known = grid.results.find({grid.values[row], grid.loads[column]});
      if (known == grid.results.end()) {  // still to come
        draw.AddRectFilled(min, max, t.well, 3.0F);
        continue;
      }
      const Result& result = accuracy.results()[known->second];
      draw.AddRectFilled(min, max, cell_color(t, result), 3.0F);
      if (result.metrics.holds) {  // a word would be wider than some cells
        draw_icon(draw, Icon::kCheck, {0.5F * (min.x + max.x), 0.5F * (min.y + max.y)}, 14.0F,
                  t.text);
      } else {
        centred({min.x, min.y - 0.5F * kCellGap}, cell - kCellGap, t.text,
                fixed(result.metrics.failed_at, 2));
      }
      if (!hovered || mouse.x < min.x || mouse.x >= max.x || mouse.y < min.y || mouse.y >= max.y) {
        continue;
      }
      under = known->second;
      draw.AddRect(min, max, t.text, 3.0F);
    }
  }
  for (std::size_t column = 0; column < grid.loads.size(); ++column) {
    centred(
        {origin.x + kMapGutter + cell * static_cast<float>(column), origin.y + kCell * rows - 3.0F},
        cell - kCellGap, t.dim, short_ratio(grid.loads[column] * ratio));
  }
  // The axes: the parameter is named above the map.
  const ImVec2 axis = text_size(look.fonts.small, "ratio");
  draw_text(draw, look.fonts.small,
            {origin.x + kMapGutter - 8.0F - axis.x,
             origin.y + kCell * rows - 3.0F + 0.5F * (kCell - axis.y)},
            t.dim, "ratio");
  if (under) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    const Result& result = accuracy.results()[*under];
    read_cell(look, result, result.experiment.load * ratio);
  }
  return clicked ? under : std::nullopt;
}

}  // namespace

std::optional<std::size_t> stability_map(const Look& look, const Accuracy& accuracy, float width) {
  std::optional<std::size_t> chosen;
  for (const Grid& grid : grids_of(accuracy)) {
    const CurveStyle style = curve_style(*look.theme, grid.settings);
    label(look.fonts.small, look.theme->dim,
          (style.own_name + ": " + series_parameter(grid.settings).name).c_str());
    if (const auto one = draw_grid(look, accuracy, grid, width)) chosen = one;
    space(8.0F);
  }
  return chosen;
}

}  // namespace substep::ui
