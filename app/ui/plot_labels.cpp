#include "app/ui/plot_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kNameLine = 12.0F;  // line spacing of names
constexpr float kNameGap = 5.0F;    // from a curve to its name

/// The visible end of a curve, and its label.
struct CurveEnd {
  ImVec2 at;
  ImU32 color = 0;
  std::string name;
};

std::vector<CurveEnd> ends_of(const PlotSpec& spec, const PlotFrame& f) {
  std::vector<CurveEnd> ends;
  for (const Series& series : spec.series) {
    const History::Slice slice = visible(*series.history, f);
    if (series.name.empty() || slice.first >= slice.last) continue;
    const float value = (*series.history)[series.channel][slice.last - 1];
    if (!drawable(value, f)) continue;
    const float x = std::min(f.x(series.history->time(slice.last - 1)), f.max.x);
    const float y = f.y(static_cast<double>(value) + series.offset);
    ends.push_back({{x, std::clamp(y, f.min.y, f.max.y)}, series.color, series.name});
  }
  return ends;
}

float name_end(const Look& look, const CurveEnd& end) {
  return end.at.x + kNameGap + text_size(look.fonts.small, end.name).x;
}

/// Whether a text of this size would cover the name of a curve.
bool covers_name(const Look& look, const std::vector<CurveEnd>& ends, ImVec2 at, ImVec2 size) {
  return std::any_of(ends.begin(), ends.end(), [&](const CurveEnd& end) {
    return at.x < name_end(look, end) && at.x + size.x > end.at.x &&
           at.y < end.at.y + 0.5F * kNameLine && at.y + size.y > end.at.y - 0.5F * kNameLine;
  });
}

}  // namespace

void draw_on_ground(const Look& look, ImDrawList& draw, ImVec2 at, ImU32 color,
                    const std::string& text, float opacity) {
  const ImVec2 size = text_size(look.fonts.small, text);
  draw.AddRectFilled({at.x - 3.0F, at.y}, {at.x + size.x + 3.0F, at.y + size.y},
                     fade(look.theme->well, opacity), 3.0F);
  draw_text(look.fonts.small, at, color, text);
}

std::vector<NamePlace> apart(const std::vector<float>& wanted, float line, float top,
                             float bottom) {
  std::vector<NamePlace> places(wanted.size(), {0.0F, false});
  const auto room = static_cast<std::size_t>(std::max(0.0F, std::floor((bottom - top) / line)));
  std::vector<std::size_t> order(std::min(room, wanted.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  // Down as far as the name above requires, then up as required by those below and the edge.
  float least = top + 0.5F * line;
  for (const std::size_t i : order) {
    places[i] = {std::max(wanted[i], least), true};
    least = places[i].y + line;
  }
  float most = bottom - 0.5F * line;
  for (std::size_t k = order.size(); k-- > 0;) {
    NamePlace& place = places[order[k]];
    place.y = std::min(place.y, most);
    most = place.y - line;
  }
  return places;
}

void draw_names(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw) {
  const std::vector<CurveEnd> ends = ends_of(spec, f);
  std::vector<float> wanted;
  wanted.reserve(ends.size());
  for (const CurveEnd& end : ends) wanted.push_back(end.at.y);
  const auto places = apart(wanted, kNameLine, f.min.y - 2.0F, f.max.y + 2.0F);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!places[i].shown) continue;
    const float x = ends[i].at.x + kNameGap;
    const std::string name = fitted(look.fonts.small, ends[i].name, f.max.x + kNameGutter - x);
    const float height = text_size(look.fonts.small, name).y;
    draw_on_ground(look, draw, {x, places[i].y - 0.5F * height}, ends[i].color, name);
  }
}

void draw_levels(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw) {
  const std::vector<CurveEnd> ends = ends_of(spec, f);
  float taken = f.min.x;  // occupied by curves and their names
  for (const CurveEnd& end : ends) {
    taken = std::max(taken, name_end(look, end) + kNameGap);
  }
  for (const Level& level : spec.levels) {
    const double v = f.logarithmic ? std::log10(std::max(level.value, 1e-300)) : level.value;
    const bool above = v > f.high;  // outside the plot: labelled at its edge
    const float y = above ? f.min.y + 0.5F : std::round(f.y(level.value)) + 0.5F;
    if (!above) draw_dashes(draw, {f.min.x, y}, {f.max.x, y}, level.color, 1.0F);
    const char* arrow = above ? " ↑" : "";
    std::string name = level.name + arrow;
    const float room = f.max.x - f.min.x + 0.5F * kNameGutter;
    if (text_size(look.fonts.small, name).x > room && !level.brief.empty()) {
      name = level.brief + arrow;
    }
    // Below the line, if there is room: the curves are mostly above.
    const ImVec2 size = text_size(look.fonts.small, name);
    const float below = y + 1.0F;
    const float over = y - size.y - 1.0F;
    const float right = f.max.x - size.x - 6.0F;
    ImVec2 at{right > taken ? right : f.min.x + 6.0F, below + size.y > f.max.y ? over : below};
    if (over >= f.min.y && covers_name(look, ends, at, size)) at.y = over;
    draw_on_ground(look, draw, at, level.color, name);
  }
}

void draw_marks(const Look& look, const PlotSpec& spec, const PlotFrame& f, ImDrawList& draw) {
  const std::vector<CurveEnd> ends = ends_of(spec, f);
  float names = f.max.x;  // left end of the curves' names
  for (const CurveEnd& end : ends) names = std::min(names, end.at.x);
  float above = f.max.y - 2.0F;  // names of levels are at the top
  for (const Mark& mark : spec.marks) {
    if (mark.time < f.t0 || mark.time > f.t1) continue;
    const float x = std::round(f.x(mark.time)) + 0.5F;
    draw_dashes(draw, {x, f.min.y}, {x, f.max.y}, mark.color, 1.0F);
    if (mark.name.empty()) continue;
    // Not over the names of the curves: beside the line, or on the far right.
    const ImVec2 size = text_size(look.fonts.small, mark.name);
    float left = x - 4.0F - size.x;
    if (left < f.min.x) left = x + 4.0F;
    if (left + size.x > names && left > x) left = f.max.x - size.x - 4.0F;
    above -= size.y;
    draw_on_ground(look, draw, {left, above}, mark.color, mark.name);
  }
}

std::optional<TimeLabel> cursor_time(const Look& look, const PlotFrame& f, const TimeAxis& axis) {
  const auto cursor = axis.cursor();
  if (!cursor || *cursor < f.t0 || *cursor > f.t1) return std::nullopt;
  TimeLabel label;
  label.text = fixed(*cursor, 2) + " s";
  label.size = text_size(look.fonts.small, label.text);
  label.left = std::clamp(f.x(*cursor) - 0.5F * label.size.x, f.min.x, f.max.x - label.size.x);
  return label;
}

void draw_cursor_time(const Look& look, const PlotFrame& f, const TimeLabel& label,
                      ImDrawList& draw) {
  const ImVec2 at(label.left, f.max.y + 3.0F);
  draw.AddRectFilled({at.x - 4.0F, at.y - 1.0F},
                     {at.x + label.size.x + 4.0F, at.y + label.size.y + 1.0F}, look.theme->control,
                     3.0F);
  draw_text(look.fonts.small, at, look.theme->text, label.text);
}

}  // namespace substep::ui
