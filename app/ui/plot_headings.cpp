#include "app/ui/plot_headings.hpp"

#include <cmath>

#include "app/text/format.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
std::string order_of_magnitude(double value) {
  if (!(value > 0.0)) return "0";
  return power_of_ten(static_cast<int>(std::lround(std::log10(value))));
}

void heading_values(const Look& look, ImVec2 at, std::string_view heading,
                    const std::vector<HeadingValue>& shown) {
  constexpr float kGap = 22.0F;  // for the dot and the space before it
  ImFont* font = look.fonts.small;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  float right = at.x + ImGui::GetContentRegionAvail().x;
  float width = 0.0F;
  for (const HeadingValue& value : shown) width += text_size(font, value.full).x + kGap;
  const bool fits = right - width >= at.x + heading_width(look, heading);
  for (const HeadingValue& value : shown) {
    const std::string& text = fits ? value.full : value.brief;
    const float left = draw_text_before(font, {right, at.y}, look.theme->text, text);
    const float middle = at.y + 0.5F * text_size(font, text).y;
    draw.AddCircleFilled({left - 8.0F, middle}, 3.5F, value.color);
    right = left - kGap;
  }
}

void compared_values(const PlotContext& in, ImVec2 at, std::string_view heading, Channel channel,
                     const ValueText& text, const ValueText& brief) {
  std::vector<HeadingValue> values;
  const auto add = [&](const History& history, ImU32 color) {
    const double v = shown_value(history, channel, in.desk.time);
    const bool known = std::isfinite(v);
    values.push_back({color, known ? text(v) : "–", known ? brief(v) : "–"});
  };
  for (std::size_t i = in.compare.runs().size(); i-- > 0;) {
    add(in.compare.runs()[i].history, compare_color(in.look, i));
  }
  add(in.session.history(), in.look.theme->blue);
  heading_values(in.look, at, heading, values);
}

void count_heading(const PlotContext& in, const char* name, const char* name_of_several,
                   Channel channel, const char* before, const char* after, const ValueText& text) {
  const double now = shown_value(in.session.history(), channel, in.desk.time);
  const bool several = in.compare.open();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const std::string value = several || !std::isfinite(now) ? "" : before + text(now) + after;
  section(in.look, several ? name_of_several : name, value);
  if (several) {
    compared_values(in, origin, name_of_several, channel, text, text);
  }
}

}  // namespace substep::ui
