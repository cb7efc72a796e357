#pragma once

#include <imgui.h>

#include <algorithm>

#include "app/ui/desk.hpp"

namespace substep::ui {

/// The window is laid out for at least this many interface pixels.
inline constexpr ImVec2 kLeastDisplay{280.0F, 240.0F};

/// Size of an interface pixel: the user's scale, or less on a display that is too small for it.
/// @param display [logical pixels]
inline float interface_scale(const Desk& desk, ImVec2 display) {
  const float fits = std::min(display.x / kLeastDisplay.x, display.y / kLeastDisplay.y);
  return std::min(static_cast<float>(desk.scale), std::max(fits, 1e-3F));
}

}  // namespace substep::ui
