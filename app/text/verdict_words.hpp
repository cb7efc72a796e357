#pragma once

#include <string>

#include "core/lab/verdict.hpp"

namespace substep {

/// A verdict as displayed: "Holds", "Disturbed at 1.20 s", "Failed at 0.352 s: joint gap 0.13 m >
/// 0.1 m (link_3)". @param text of a Verdict: "holds", "fails at 0.352 s: ..."
std::string verdict_words(const std::string& text);

/// "joint gap 0.13 m", "energy gain 37 kJ", "moved 0.2 m"
std::string exceeded_label(const Exceeded& exceeded);
/// A sentence that names the value, the limit and what they mean.
std::string exceeded_sentence(const Exceeded& exceeded);

/// Without the reason: "Holds", "Failed at 0.35 s", and "Ready" before the first frame was judged.
/// @param judged whether a frame was judged
std::string verdict_note(const Verdict& verdict, bool judged);

}  // namespace substep
