#include "app/ui/plot_headings.hpp"

#include <cmath>

#include "app/text/format.hpp"
#include "app/ui/plot.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {

namespace {
constexpr float kLegendGap = 22.0F;  // for the dot and the space before it
}  // namespace

float legend(const Look& look, float right, float y, ImU32 color, const std::string& text) {
  const ImVec2 size = text_size(look.fonts.small, text.c_str());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float x = right - size.x;
  draw_text(draw, look.fonts.small, {x, y}, look.theme->text, text.c_str());
  draw.AddCircleFilled({x - 8.0F, y + 0.5F * size.y}, 3.5F, color);
  return x - kLegendGap;
}

std::string order_of_magnitude(double value) {
  if (!(value > 0.0)) return "0";
  return power_of_ten(static_cast<int>(std::lround(std::log10(value))));
}

void compared_values(const PlotContext& in, ImVec2 heading, float left, Channel channel,
                     const ValueText& text, const ValueText& brief) {
  struct Value {
    ImU32 color;
    std::string full;
    std::string brief;
  };
  std::vector<Value> values;
  float full_width = 0.0F;
  const auto add = [&](const History& history, ImU32 color) {
    const double v = shown_value(history, channel, in.desk.time);
    const bool known = std::isfinite(v);
    values.push_back({color, known ? text(v) : "–", known ? brief(v) : "–"});
    full_width += text_size(in.look.fonts.small, values.back().full.c_str()).x + kLegendGap;
  };
  add(in.session.history(), in.look.theme->blue);
  for (std::size_t i = 0; i < in.compare.runs().size(); ++i) {
    add(in.compare.runs()[i].history, compare_color(in.look, i));
  }
  float right = heading.x + ImGui::GetContentRegionAvail().x;
  const bool fits = right - full_width >= left;
  for (std::size_t i = values.size(); i-- > 0;) {
    const std::string& shown = fits ? values[i].full : values[i].brief;
    right = legend(in.look, right, heading.y, values[i].color, shown);
  }
}

void named_values(const PlotContext& in, ImVec2 heading, float left,
                  const std::vector<NamedChannel>& shown) {
  const float end = heading.x + ImGui::GetContentRegionAvail().x;
  const auto text = [&](const NamedChannel& one, bool brief) {
    const double value = shown_value(in.session.history(), one.channel, in.desk.time);
    if (!std::isfinite(value)) return std::string(one.name);
    return std::string(one.name) + " " + (brief ? order_of_magnitude(value) : coarse_number(value));
  };
  float full = 0.0F;
  for (const NamedChannel& one : shown) {
    full += text_size(in.look.fonts.small, text(one, false).c_str()).x + kLegendGap;
  }
  const bool brief = end - full < left;
  float right = end;
  for (const NamedChannel& one : shown) {
    right = legend(in.look, right, heading.y, one.color, text(one, brief));
  }
}

void count_heading(const PlotContext& in, const char* name, const char* name_of_several,
                   Channel channel, const char* before, const char* after, const ValueText& text) {
  const double now = shown_value(in.session.history(), channel, in.desk.time);
  const bool several = in.compare.open();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const std::string value = several || !std::isfinite(now) ? "" : before + text(now) + after;
  section(in.look, several ? name_of_several : name, value.c_str());
  if (several) {
    compared_values(in, origin, origin.x + heading_width(in.look, name_of_several), channel, text,
                    text);
  }
}

}  // namespace substep::ui
