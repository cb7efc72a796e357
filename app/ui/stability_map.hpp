#pragma once

#include <imgui.h>

#include <optional>

#include "app/lab/accuracy.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// How long runs survive, by the mass ratio and the parameter of a mode: a cell each, blue where it
/// holds, orange where it fails, the paler the longer it stood. @param width logical pixels
/// @return the result whose cell was clicked
std::optional<std::size_t> stability_map(const Look& look, const Accuracy& accuracy, float width);

}  // namespace substep::ui
