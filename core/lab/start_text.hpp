#pragma once

#include <string>

#include "core/model/scene.hpp"
#include "core/sim/report.hpp"
#include "core/sim/start.hpp"

namespace substep {

/// Errors of a start and their treatment, as one line of text: "The start was inconsistent: joint
/// 'x' open by 9 cm, 'y' moving apart at 1.2 m/s; projected. Energy 194 J before, 12 J after."
/// Empty if nothing was changed.
std::string start_text(const Scene& scene, const StartReport& report);

/// The deepest overlap of the start and what happens to it: "'b' and 'a' overlap by 20 cm at the
/// start; they are parted without speed." Empty below a
/// thousandth of the width of the smaller body, and for contacts that are springs.
/// @param start report of the initial state
std::string overlap_text(const Scene& scene, const Settings& settings, const FrameReport& start);

/// "open by 9 cm, moving apart at 1.2 m/s": the errors of one joint beyond tolerance.
std::string fault_text(const JointStart& start);

}  // namespace substep
