#include "core/lab/doctor_words.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/format_text.hpp"

namespace substep {

const char* word_of(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::kHolds:
      return "holds";
    case Diagnosis::Verdict::kHoldsNarrowly:
      return "holds narrowly";
    case Diagnosis::Verdict::kFails:
      return "fails";
    case Diagnosis::Verdict::kNotUnderstood:
      break;
  }
  return "not understood";
}

std::string step_text(double step) {
  if (!std::isfinite(step)) return "no limit";
  return step < 0.1 ? format_text("%.3g ms", 1e3 * step) : format_text("%.3g s", step);
}

std::string summary_of(const Diagnosis& diagnosis) {
  const std::string engine = diagnosis.question.engine->title;
  if (!std::isfinite(diagnosis.step)) {
    return "No limit was found for " + engine +
           ": no joint force resists, and no drive or spring is explicit";
  }
  const bool has_comma = engine.find(',') != std::string::npos;
  return engine + (has_comma ? ", needs" : " needs") + " steps below " + step_text(diagnosis.step) +
         ", set by " + diagnosis.limited_by;
}

std::string disagreement_of(const Diagnosis& diagnosis) {
  if (!diagnosis.at_step) return "";
  const bool is_below = diagnosis.step > diagnosis.question.step;
  if (!diagnosis.at_step->holds) {
    return is_below ? "It fails below the largest step: by errors that are not those of the "
                      "linearised motion."
                    : "";
  }
  if (is_below || diagnosis.step == diagnosis.question.step) return "";
  return diagnosis.by_drive
             ? "Drives and springs of substep are implicit."
             : "It holds above the largest step: for these seconds, not for certain.";
}

std::vector<EngineSetting> engine_settings(const Scene& scene, const Diagnosis& diagnosis) {
  std::vector<EngineSetting> settings;
  if (!std::isfinite(diagnosis.step)) return settings;
  const Engine& asked = *diagnosis.question.engine;
  const bool has_drives = !diagnosis.drives.empty();
  const double step = std::min(diagnosis.step / kSafeMargin, scene.frame);
  const int count = static_cast<int>(std::ceil(scene.frame / step * (1.0 - 1e-12)));
  for (const Engine& engine : kEngines) {
    const bool is_alike = engine.stiffness == asked.stiffness && engine.damping == asked.damping &&
                          engine.damps_springs == asked.damps_springs;
    if (&engine != &asked && !is_alike && has_drives) continue;  // another question
    settings.push_back({&engine, setting_of(engine, step, count), engine.assumed && has_drives});
  }
  return settings;
}

}  // namespace substep
