#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kMapGutter = 44.0F;  // the values of the parameter
constexpr float kCell = 22.0F;       // height
constexpr float kCellGap = 2.0F;     // between cells
constexpr float kWidest = 96.0F;     // of a cell
constexpr float kMapFoot = 36.0F;    // mass ratios and their title
constexpr float kBesideWidth = 540.0F;
constexpr float kBetween = 28.0F;  // between maps

/// Position and sizes of a map.
struct Layout {
  ImVec2 origin;  // of the cells
  ImVec2 cell;

  /// Upper left corner of a cell.
  [[nodiscard]] ImVec2 corner(std::size_t column, std::size_t row) const {
    return origin + ImVec2(static_cast<float>(column), static_cast<float>(row)) * cell;
  }
};

/// The cells of one mode.
struct Grid {
  std::string series;
  Settings settings;           // of any of its runs
  std::vector<double> values;  // of the parameter, from coarse to fine
  std::vector<double> loads;   // ascending
  std::map<std::pair<double, double>, std::size_t> results;  // by value and load
};

bool is_constant(const Grid& grid) { return grid.settings.mode == Mode::kConst; }

/// "adaptive per frame: alpha": the mode and the vertical axis.
std::string name_of(const Look& look, const Grid& grid) {
  if (is_constant(grid)) return "constant N: sub-steps per frame";
  return curve_style(*look.theme, grid.settings).own_name + ": " +
         series_parameter(grid.settings).name;
}

void add_once(std::vector<double>& list, double value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// The modes with planned runs under other loads, with the results so far.
std::vector<Grid> grids_of(const Accuracy& accuracy) {
  std::vector<Grid> grids;
  const auto find = [&](const Settings& s) {
    return std::find_if(grids.begin(), grids.end(),
                        [&](const Grid& grid) { return grid.series == series_name(s); });
  };
  for (const Experiment& e : accuracy.experiments()) {
    if (e.load == 1.0) continue;
    auto own = find(e.settings);
    if (own == grids.end()) {
      own = grids.insert(own, Grid{series_name(e.settings), e.settings, {}, {1.0}, {}});
    }
    add_once(own->values, series_parameter(e.settings).value);
    add_once(own->loads, e.load);
  }
  for (std::size_t i = 0; i < accuracy.results().size(); ++i) {
    const Experiment& e = accuracy.results()[i].experiment;
    if (const auto own = find(e.settings); own != grids.end()) {
      own->results[{series_parameter(e.settings).value, e.load}] = i;
    }
  }
  for (Grid& own : grids) {
    std::sort(own.values.begin(), own.values.end());
    if (!is_constant(own)) std::reverse(own.values.begin(), own.values.end());
    std::sort(own.loads.begin(), own.loads.end());
  }
  return grids;
}

/// "320", "3.2k": cells are narrow.
std::string short_ratio(double ratio) {
  return ratio < 1e3 ? plain_number(ratio) : plain_number(1e-3 * ratio) + "k";
}

ImU32 cell_color(const Theme& t, const Result& result) {
  if (result.metrics.holds) return fade(t.blue, t.dark ? 0.55F : 0.3F);
  const auto survived = static_cast<float>(result.metrics.failed_at / result.experiment.duration);
  return fade(t.orange, 0.5F - 0.35F * std::min(1.0F, survived));
}

void read_cell(const Look& look, const Result& result, double ratio) {
  const Theme& t = *look.theme;
  const Settings& s = result.experiment.settings;
  const std::string name = curve_style(t, s).name() + ", " + parameter_text(s);
  read_out(look, std::vector<ReadOutLine>{{name, t.text, true},
                                          {"mass ratio " + plain_number(ratio), t.dim},
                                          {verdict_words(result.metrics.verdict),
                                           result.metrics.holds ? t.dim : t.orange},
                                          {"Click to run it, or drag", t.accent}});
}

/// Whether a result belongs to the current run.
bool runs_now(const Lab& lab, const Result& result) {
  const Settings& now = lab.session.settings();
  const Settings& of = result.experiment.settings;
  return lab.plain_scene == lab.accuracy.scene() && lab.load == result.experiment.load &&
         series_name(now) == series_name(of) &&
         series_parameter(now).value == series_parameter(of).value;
}

/// Position of N among the rows of constant N, on a logarithmic scale; outside the map for N below
/// the first row or above the last [rows]. @param values at least two, ascending
double row_of(const std::vector<double>& values, double n) {
  std::size_t i = 0;
  while (i + 2 < values.size() && n > values[i + 1]) ++i;
  return static_cast<double>(i) + std::log(n / values[i]) / std::log(values[i + 1] / values[i]);
}

/// The mean N of a row of adaptive sub-stepping for each load.
struct Path {
  double alpha = 0.0;
  std::vector<double> n;  // by load, 0 if unknown
};

/// At the scene's own alpha, or the nearest on the map.
Path path_of(const Accuracy& accuracy, const std::vector<Grid>& grids) {
  const auto adaptive = std::find_if(grids.begin(), grids.end(), [](const Grid& g) {
    return entry_of(g.settings.mode).count == SubstepCount::kStable;
  });
  if (adaptive == grids.end()) return {};
  const auto distance = [&](double alpha) {
    return std::abs(std::log(alpha / accuracy.scene()->settings.alpha));
  };
  Path path;
  path.alpha = *std::min_element(adaptive->values.begin(), adaptive->values.end(),
                                 [&](double a, double b) { return distance(a) < distance(b); });
  for (const double load : adaptive->loads) {
    const auto known = adaptive->results.find({path.alpha, load});
    const bool is_there = known != adaptive->results.end();
    const Work work = is_there ? accuracy.results()[known->second].metrics.work : Work{};
    path.n.push_back(work.frames > 0
                         ? static_cast<double>(work.substeps) / static_cast<double>(work.frames)
                         : 0.0);
  }
  return path;
}

/// A line over the cells of constant N: the mean N of adaptive sub-stepping. It leaves the map
/// where that exceeds the largest constant N.
void draw_path(const Look& look, const Grid& grid, const Path& path, const Layout& layout) {
  if (grid.values.size() < 2) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = look.theme->teal;
  std::vector<ImVec2> points;
  for (std::size_t i = 0; i < path.n.size() && i < grid.loads.size(); ++i) {
    if (path.n[i] <= 0.0) continue;
    points.push_back({layout.origin.x + layout.cell.x * (static_cast<float>(i) + 0.5F),
                      layout.origin.y + layout.cell.y * static_cast<float>(
                                                            row_of(grid.values, path.n[i]) + 0.5)});
  }
  draw.PushClipRect(layout.origin, layout.corner(grid.loads.size(), grid.values.size()), true);
  draw.AddPolyline(points.data(), static_cast<int>(points.size()), look.theme->panel, 0, 5.0F);
  draw.AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, 2.0F);
  for (const ImVec2& at : points) {
    draw.AddCircleFilled(at, 4.5F, look.theme->panel);
    draw.AddCircleFilled(at, 3.0F, color);
  }
  draw.PopClipRect();
}

/// Centred text in a cell.
void draw_centred(const Look& look, ImVec2 from, ImVec2 size, ImU32 color,
                  const std::string& text) {
  const ImVec2 extent = text_size(look.fonts.small, text);
  draw_text(look.fonts.small, from + (size - extent) * 0.5F, color, text);
}

void draw_ground(const Look& look, const Result& result, ImVec2 min, ImVec2 max) {
  ImGui::GetWindowDrawList()->AddRectFilled(min, max, cell_color(*look.theme, result), 3.0F);
}

// Over a line through the cells.
void draw_text_of_cell(const Look& look, const Result& result, ImVec2 min, ImVec2 max) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = look.theme->text;
  if (result.metrics.holds) {  // a word would be wider than some cells
    const ImVec2 middle = (min + max) * 0.5F;
    draw.AddCircleFilled(middle, 8.0F, look.theme->panel);
    draw.AddCircleFilled(middle, 8.0F, cell_color(*look.theme, result));
    draw_icon(draw, Icon::kCheck, middle, 14.0F, color);
  } else {
    draw_centred(look, min, max - min, color, fixed(result.metrics.failed_at, 2));
  }
}

/// The values of the parameter on the left, the mass ratios below.
void draw_axes(const Look& look, const Grid& grid, const Layout& layout, double ratio) {
  const ImU32 color = look.theme->dim;
  for (std::size_t row = 0; row < grid.values.size(); ++row) {
    const std::string text = plain_number(grid.values[row]);
    const ImVec2 corner = layout.corner(0, row);
    const float down = 0.5F * (kCell - text_size(look.fonts.small, text).y);
    draw_text_before(look.fonts.small, {corner.x - 8.0F, corner.y + down}, color, text);
  }
  for (std::size_t column = 0; column < grid.loads.size(); ++column) {
    draw_centred(look, layout.corner(column, grid.values.size()) - ImVec2(0.0F, 3.0F),
                 {layout.cell.x - kCellGap, kCell}, color, short_ratio(grid.loads[column] * ratio));
  }
  const float width = layout.cell.x * static_cast<float>(grid.loads.size());
  draw_centred(look, layout.corner(0, grid.values.size()) + ImVec2(0.0F, 12.0F),
               {width - kCellGap, kCell}, color, "mass ratio, heaviest to lightest body");
}

/// The map is the last item. While it has keyboard focus the arrow keys go from the cell of the
/// current run to the next, and do not leave the map.
/// @return the result of that cell
std::optional<std::size_t> chosen_by_key(const Lab& lab, const Grid& grid) {
  if (!ImGui::IsItemFocused() || !ImGui::GetIO().NavVisible) return std::nullopt;
  const ImGuiID id = ImGui::GetItemID();
  const auto pressed = [&](ImGuiKey key) {
    ImGui::SetKeyOwner(key, id);
    return ImGui::IsKeyPressed(key, id, ImGuiInputFlags_Repeat) ? 1 : 0;
  };
  const int right = pressed(ImGuiKey_RightArrow) - pressed(ImGuiKey_LeftArrow);
  const int down = pressed(ImGuiKey_DownArrow) - pressed(ImGuiKey_UpArrow);
  if (right == 0 && down == 0) return std::nullopt;
  const auto now = std::find_if(grid.results.begin(), grid.results.end(), [&](const auto& entry) {
    return runs_now(lab, lab.accuracy.results()[entry.second]);
  });
  if (now == grid.results.end()) return grid.results.begin()->second;
  const auto neighbour = [](const std::vector<double>& of, double value, int by) {
    const auto at = std::find(of.begin(), of.end(), value) - of.begin();
    const auto last = static_cast<std::ptrdiff_t>(of.size()) - 1;
    return of[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + by, 0, last))];
  };
  const auto next = grid.results.find({neighbour(grid.values, now->first.first, down),
                                       neighbour(grid.loads, now->first.second, right)});
  if (next == grid.results.end() || next == now) return std::nullopt;
  return next->second;
}

/// @return the result chosen by the pointer or a key
std::optional<std::size_t> draw_grid(const Look& look, const Lab& lab, const Grid& grid,
                                     const Path& path, float width) {
  const Theme& t = *look.theme;
  const Accuracy& accuracy = lab.accuracy;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const auto rows = static_cast<float>(grid.values.size());
  const auto columns = static_cast<float>(grid.loads.size());
  const Layout layout{{corner.x + kMapGutter, corner.y},
                      {std::min(kWidest, (width - kMapGutter) / columns), kCell}};
  const ImVec2 size(kMapGutter + layout.cell.x * columns, kCell * rows + kMapFoot);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::InvisibleButton(grid.series.c_str(), size);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool pointed = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const bool pressed = ImGui::IsItemActivated();
  const bool dragged = ImGui::IsItemActive();
  const std::optional<std::size_t> by_key = chosen_by_key(lab, grid);
  draw_focus(look);
  const double ratio = mass_ratio(*accuracy.scene());
  draw_axes(look, grid, layout, ratio);
  std::optional<std::size_t> under;
  bool is_live = false;
  for (std::size_t row = 0; row < grid.values.size(); ++row) {
    for (std::size_t column = 0; column < grid.loads.size(); ++column) {
      const ImVec2 min = layout.corner(column, row);
      const ImVec2 max = min + layout.cell - ImVec2(kCellGap, kCellGap);
      const auto known = grid.results.find({grid.values[row], grid.loads[column]});
      if (known == grid.results.end()) {  // not yet computed
        draw.AddRectFilled(min, max, t.well, 3.0F);
        continue;
      }
      const Result& result = accuracy.results()[known->second];
      draw_ground(look, result, min, max);
      mark(std::to_string(known->second), min, max, "map");
      const bool live = runs_now(lab, result);
      if (live) draw.AddRect({min.x - 1, min.y - 1}, {max.x + 1, max.y + 1}, t.text, 4.0F, 0, 2);
      if (!pointed || mouse.x < min.x || mouse.x >= max.x || mouse.y < min.y || mouse.y >= max.y) {
        continue;
      }
      under = known->second;
      is_live = live;
      draw.AddRect(min, max, t.text, 3.0F);
    }
  }
  if (is_constant(grid)) draw_path(look, grid, path, layout);
  for (std::size_t row = 0; row < grid.values.size(); ++row) {
    for (std::size_t column = 0; column < grid.loads.size(); ++column) {
      const auto known = grid.results.find({grid.values[row], grid.loads[column]});
      if (known == grid.results.end()) continue;
      const ImVec2 min = layout.corner(column, row);
      draw_text_of_cell(look, accuracy.results()[known->second], min,
                        min + layout.cell - ImVec2(kCellGap, kCellGap));
    }
  }
  if (!under) return by_key;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  const Result& result = accuracy.results()[*under];
  read_cell(look, result, result.experiment.load * ratio);
  return pressed || (dragged && !is_live) ? under : by_key;
}

}  // namespace

std::optional<std::size_t> stability_map(const Look& look, const Lab& lab, float width) {
  const std::vector<Grid> grids = grids_of(lab.accuracy);
  const Path path = path_of(lab.accuracy, grids);
  const bool beside = width > kBesideWidth;  // side by side
  const float each = beside ? (width - kBetween) / static_cast<float>(grids.size()) : width;
  std::optional<std::size_t> chosen;
  for (const Grid& grid : grids) {
    if (beside && &grid != &grids.front()) ImGui::SameLine(0.0F, kBetween);
    ImGui::BeginGroup();
    label(look.fonts.small, look.theme->text, name_of(look, grid));
    if (const auto one = draw_grid(look, lab, grid, path, each)) chosen = one;
    if (is_constant(grid) && !path.n.empty()) {
      label(look.fonts.small, look.theme->teal,
            "Line: mean N of adaptive sub-stepping, alpha = " + plain_number(path.alpha));
    }
    ImGui::EndGroup();
    if (!beside) space(8.0F);
  }
  return chosen;
}

}  // namespace substep::ui
