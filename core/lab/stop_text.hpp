#pragma once

#include <string>

#include "core/model/scene.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// The resources that a frame would have needed, and for what, as one line of text: "44850 contacts
/// of 300 bodies would need 2.4 GiB for the direct solver; the budget is 512 MiB".
std::string overrun_text(const Overrun& overrun);

/// The cause of an incomplete frame, as one line of text: "not finite (link_3)". Empty if complete.
std::string stop_text(const Scene& scene, const FrameReport& report);

}  // namespace substep
