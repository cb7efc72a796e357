#pragma once

#include <string>

#include "core/model/scene.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// What a frame would have taken and what asked for it, in one line for people: "44850 contacts of
/// 300 bodies would need 2.4 GiB for the direct solver; the budget is 512 MiB".
std::string overrun_text(const Overrun& overrun);

/// Why a frame did not end, in one line for people: "not finite (link_3)". Empty where it did.
std::string stop_text(const Scene& scene, const FrameReport& report);

}  // namespace substep
