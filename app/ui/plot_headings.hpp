#pragma once
// Heading of a plot: its name, and its values on the right.

#include <imgui.h>

#include <functional>
#include <string>
#include <vector>

#include "app/ui/plots.hpp"

namespace substep::ui {

/// Formats a value.
using ValueText = std::function<std::string(double)>;

/// A coloured dot with name and value, right-aligned at `right`. @return its left edge
float legend(const Look& look, float right, float y, ImU32 color, const std::string& text);

/// "10⁻⁸"
std::string order_of_magnitude(double value);

/// The values of the compared runs, right-aligned. @param left end of the heading
/// @param text formats a value @param brief the same in less room
void compared_values(const PlotContext& in, ImVec2 heading, float left, Channel channel,
                     const ValueText& text, const ValueText& brief);

struct NamedChannel {
  Channel channel;
  const char* name;
  ImU32 color;
};
/// Names with values, the first on the right; orders of magnitude in narrow plots.
void named_values(const PlotContext& in, ImVec2 heading, float left,
                  const std::vector<NamedChannel>& shown);

/// A plot's heading with its value, or with the values of all compared runs.
void count_heading(const PlotContext& in, const char* name, const char* name_of_several,
                   Channel channel, const char* before, const char* after, const ValueText& text);

}  // namespace substep::ui
