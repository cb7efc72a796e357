#pragma once
// The words of a diagnosis, the same on the command line, in JSON, on a page and on a badge.

#include <string>
#include <vector>

#include "core/lab/doctor.hpp"

namespace substep {

/// "holds", "holds narrowly", "fails" or "not understood"
const char* word_of(Diagnosis::Verdict verdict);

/// "2.38 ms", or "no limit". @param step [s]
std::string step_text(double step);

/// The answer in a sentence, without its end: "MuJoCo, integrator Euler, needs steps below 1.49 ms,
/// set by the drive of elbow at the start".
std::string summary_of(const Diagnosis& diagnosis);

/// Why the run with the asked step and the foretold step disagree, as a sentence; or "".
std::string disagreement_of(const Diagnosis& diagnosis);

/// What an engine's users set for the largest step with kSafeMargin.
struct EngineSetting {
  const Engine* engine = nullptr;
  std::string text;
  bool assumed = false;  // its treatment of the drives of this model is an assumption
};

/// The settings of the engine that was asked and of those that treat drives and springs alike; of
/// all if the model has neither. None if there is no limit.
std::vector<EngineSetting> engine_settings(const Scene& scene, const Diagnosis& diagnosis);

}  // namespace substep
