#include "app/cli/map_picture.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep::cli {
namespace {

// Pixels.
constexpr int kCellWidth = 46;
constexpr int kCellHeight = 26;
constexpr int kLeft = 62;   // of each map, for the alpha labels
constexpr int kTop = 64;    // of the picture, for its title
constexpr int kTitle = 26;  // of each map, for its title
constexpr int kFoot = 54;   // of each map, for the value labels and their title
constexpr int kRight = 18;

template <class Value, class Of>
std::vector<Value> values_of(const std::vector<MapCell>& cells, Of&& of) {
  std::vector<Value> values;
  for (const MapCell& cell : cells) {
    const Value value = of(cell);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

/// 0.05, 400, 1e4.
std::string short_number(double x) {
  if (x < 1e4) return number_text(x);
  return format_text("1e%.0f", std::log10(x));
}

std::string text(double x, double y, const char* style, const std::string& what) {
  return format_text("<text x='%g' y='%g' class='%s'>", x, y, style) + what + "</text>\n";
}

/// Darker for more sub-steps, on a logarithmic scale from 1 to 1,000.
std::string colour_of(const MapCell& cell) {
  if (!cell.run->metrics.holds) return "#f6c9b4";
  const double depth =
      std::min(1.0, std::log10(std::max(1, cell.run->metrics.work.n_median)) / 3.0);
  const auto mixed = [&](int light, int deep) {
    return static_cast<int>(std::lround(light + (deep - light) * depth));
  };
  return format_text("#%02x%02x%02x", mixed(0xdd, 0x3a), mixed(0xee, 0x86), mixed(0xfb, 0xd1));
}

std::string label_of(const MapCell& cell) {
  const Metrics& m = cell.run->metrics;
  return m.holds ? std::to_string(m.work.n_median) : format_text("× %.1f", cell.run->time);
}

struct Place {
  int x;
  int y;
};

double alpha_of(const MapCell& cell) { return cell.run->cell.settings.alpha; }
SolverKind solver_of(const MapCell& cell) { return cell.run->cell.settings.solver; }

std::string one_map(const std::vector<MapCell>& cells, Place at) {
  const auto alphas = values_of<double>(cells, alpha_of);
  const auto values = values_of<double>(cells, [](const MapCell& c) { return c.value; });
  const auto index = [](const std::vector<double>& of, double x) {
    return static_cast<int>(std::find(of.begin(), of.end(), x) - of.begin());
  };
  std::string svg;
  for (const MapCell& cell : cells) {
    const int x = at.x + index(values, cell.value) * kCellWidth;
    const int y = at.y + index(alphas, alpha_of(cell)) * kCellHeight;
    svg += format_text("<rect x='%d' y='%d' width='%d' height='%d' fill='%s'/>", x, y,
                       kCellWidth - 2, kCellHeight - 2, colour_of(cell).c_str());
    svg += text(x + kCellWidth / 2 - 1, y + kCellHeight / 2 + 3, "cell", label_of(cell));
  }
  for (const double alpha : alphas) {
    svg += text(at.x - 8, at.y + index(alphas, alpha) * kCellHeight + kCellHeight / 2 + 3, "end",
                number_text(alpha));
  }
  const int below = at.y + static_cast<int>(alphas.size()) * kCellHeight;
  for (const double value : values) {
    svg += text(at.x + index(values, value) * kCellWidth + kCellWidth / 2 - 1, below + 14, "middle",
                short_number(value));
  }
  const bool direct = solver_of(cells.front()) == SolverKind::kBpp;
  svg += text(at.x, below + 34, "start", cells.front().label);
  svg += text(at.x, at.y - 8, "head", direct ? "direct solver (BPP)" : "PGS");
  svg += text(at.x - 8, at.y - 8, "end", "alpha");
  return svg;
}

}  // namespace

std::string map_picture(const std::vector<MapCell>& cells) {
  const auto maps = values_of<std::string>(cells, [](const MapCell& c) { return c.map; });
  const auto solvers = values_of<SolverKind>(cells, solver_of);
  std::string svg;
  int width = 0;
  int y = kTop;
  for (const SolverKind solver : solvers) {
    int x = 0;
    int height = 0;
    for (const std::string& map : maps) {
      std::vector<MapCell> own;
      std::copy_if(cells.begin(), cells.end(), std::back_inserter(own),
                   [&](const MapCell& c) { return c.map == map && solver_of(c) == solver; });
      if (own.empty()) continue;
      svg += one_map(own, {x + kLeft, y + kTitle});
      const auto columns = values_of<double>(own, [](const MapCell& c) { return c.value; }).size();
      const auto rows = values_of<double>(own, alpha_of).size();
      x += kLeft + static_cast<int>(columns) * kCellWidth + kRight;
      height = std::max(height, kTitle + static_cast<int>(rows) * kCellHeight + kFoot);
    }
    width = std::max(width, x);
    y += height;
  }
  return format_text(
             "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' width='%d' "
             "height='%d'>\n",
             width, y, width, y) +
         "<style>text{font:12px system-ui,sans-serif;fill:#161b24}.cell,.middle{text-anchor:middle}"
         ".cell{font-size:11px}.end{text-anchor:end}.head{font-weight:600}"
         ".title{font-size:16px;font-weight:600}.middle,.end,.start,.note{fill:#556072}</style>\n"
         "<rect width='100%' height='100%' fill='#ffffff'/>\n" +
         text(kLeft, 28, "title", "Where adaptive sub-steps hold") +
         text(kLeft, 48, "note",
              "blue: holds, with the median of the sub-steps per frame · orange ×: fails, after so "
              "many "
              "seconds") +
         svg + "</svg>\n";
}

}  // namespace substep::cli
