#pragma once
// What stands above a plot: its name, and at the right the values that it shows.

#include <imgui.h>

#include <functional>
#include <string>
#include <vector>

#include "app/ui/plots.hpp"

namespace substep::ui {

/// A value as people read it.
using ValueText = std::function<std::string(double)>;

/// A coloured dot with its name and value, right-aligned at `right`. @return where it starts
float legend(const Look& look, float right, float y, ImU32 color, const std::string& text);

/// "10⁻⁸"
std::string order_of_magnitude(double value);

/// The value of each run that is compared, right-aligned. @param left where the heading ends
/// @param text of a value  @param brief the same where there is little room
void compared_values(const PlotContext& in, ImVec2 heading, float left, Channel channel,
                     const ValueText& text, const ValueText& brief);

struct NamedChannel {
  Channel channel;
  const char* name;
  ImU32 color;
};
/// Names with their values, the first at the right; orders of magnitude where there is little room.
void named_values(const PlotContext& in, ImVec2 heading, float left,
                  const std::vector<NamedChannel>& shown);

/// A plot's heading: with its value, or with the values of all that is compared.
void count_heading(const PlotContext& in, const char* name, const char* name_of_several,
                   Channel channel, const char* before, const char* after, const ValueText& text);

}  // namespace substep::ui
