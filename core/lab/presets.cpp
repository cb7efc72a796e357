#include "core/lab/presets.hpp"

#include <array>

namespace substep {
namespace {

constexpr std::array kPresets{
    Preset{"paper", "Adaptive sub-steps as in the paper: alpha 0.1, decided once a frame.", {}},
    Preset{"recommended",
           "At most four sub-steps a frame and adaptive damping for what they do not reach: holds "
           "most of the hard set at the least work, and slows motions a little.",
           {.mode = Mode::kCapped, .n_cap = 4}},
};

}  // namespace

std::span<const Preset> presets() { return kPresets; }

}  // namespace substep
