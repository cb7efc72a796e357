#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>

#include "app/lab/accuracy.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// Error against cost on logarithmic axes: a curve per method, the Pareto front, the failed runs on
/// a separate rail. @param current settings of the run, ringed @return the result that was clicked
std::optional<std::size_t> accuracy_picture(const Look& look, const Accuracy& accuracy,
                                            const Settings& current, ImVec2 size);

}  // namespace substep::ui
