#pragma once
// Heading of a plot: its name, and its values on the right.

#include <imgui.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/plots.hpp"

namespace substep::ui {

/// Formats a value.
using ValueText = std::function<std::string(double)>;

/// "10⁻⁸"
std::string order_of_magnitude(double value);

/// A value in a heading, with a dot in its colour.
struct HeadingValue {
  ImU32 color;
  std::string full;
  std::string brief;  // if there is little room
};
/// Values, right-aligned in a heading, the first on the right. @param at corner of the heading
void heading_values(const Look& look, ImVec2 at, std::string_view heading,
                    const std::vector<HeadingValue>& shown);

/// The values of the compared runs. @param text formats a value @param brief the same in less room
void compared_values(const PlotContext& in, ImVec2 at, std::string_view heading, Channel channel,
                     const ValueText& text, const ValueText& brief);

/// A plot's heading with its value, or with the values of all compared runs.
void count_heading(const PlotContext& in, const char* name, const char* name_of_several,
                   Channel channel, const char* before, const char* after, const ValueText& text);

}  // namespace substep::ui
