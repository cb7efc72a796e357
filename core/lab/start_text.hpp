#pragma once

#include <string>

#include "core/model/scene.hpp"
#include "core/sim/start.hpp"

namespace substep {

/// What was wrong with a start and what became of it, in one line for people: "The start was
/// inconsistent: joint 'x' open by 9 cm, 'y' moving apart at 1.2 m/s; projected. Energy 194 J
/// before, 12 J after." Empty where nothing was changed.
std::string start_text(const Scene& scene, const StartReport& report);

/// "open by 9 cm, moving apart at 1.2 m/s": what of one joint is beyond tolerance.
std::string fault_text(const JointStart& start);

}  // namespace substep
