#pragma once

#include <imgui.h>

#include <optional>

#include "app/lab/lab.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// How long runs survive, by the mass ratio and the parameter of a mode: a cell each, blue where it
/// holds, orange where it fails, the paler the longer it stood. The present run is framed, and
/// a line over constant N shows the mean N of adaptive sub-stepping. @param width logical pixels
/// @return the result whose cell was pressed, or is passed by a pointer that is dragged
std::optional<std::size_t> stability_map(const Look& look, const Lab& lab, float width);

}  // namespace substep::ui
