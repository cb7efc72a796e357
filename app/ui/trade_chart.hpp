#pragma once

#include <cstddef>
#include <optional>

#include "app/lab/accuracy.hpp"
#include "app/ui/look.hpp"

namespace substep::ui {

/// The conclusion of the comparison with a constant N, and the choice of its alpha.
void trade_head(const Look& look, Accuracy& accuracy);

/// Sub-steps per frame under each load: a bar for adaptive sub-stepping and one for the smallest
/// constant N that is as accurate, each with its error; a line for the constant N that serves all
/// loads. @param width logical pixels @return the result whose bar was clicked
std::optional<std::size_t> trade_chart(const Look& look, Accuracy& accuracy, float width);

}  // namespace substep::ui
