#pragma once

#include <imgui.h>

#include <optional>

#include "app/lab/lab.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// Survival time by mass ratio and mode parameter: one cell each, blue if stable, orange if it
/// fails, paler for later failures. The current run is framed, and a line over constant N shows the
/// mean N of adaptive sub-stepping. @param width logical pixels
/// @return the result whose cell is pressed, dragged over or reached by an arrow key
std::optional<std::size_t> stability_map(const Look& look, const Lab& lab, float width);

}  // namespace substep::ui
