#include "core/lab/stop_text.hpp"

#include <cmath>

#include "core/collision/detector.hpp"
#include "core/model/budget.hpp"
#include "core/model/format_text.hpp"

namespace substep {
namespace {

std::string memory_text(double bytes) {
  constexpr double kGibibyte = 1024.0 * kMebibyte;
  return bytes >= kGibibyte ? format_text("%.1f GiB", bytes / kGibibyte)
                            : format_text("%.0f MiB", bytes / kMebibyte);
}

std::string counted(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

std::string overrun_text(const Overrun& overrun) {
  const std::string of_bodies =
      " of " + std::to_string(overrun.bodies) + (overrun.bodies == 1 ? " body" : " bodies");
  if (overrun.memory > 0.0) {
    const std::string what =
        overrun.contacts > 0 ? counted(overrun.contacts, "contact") : counted(overrun.rows, "row");
    return what + of_bodies + " would need " + memory_text(overrun.memory) +
           " for the direct solver; the budget is " + memory_text(overrun.budget);
  }
  std::string what = overrun.of_substep ? "A sub-step" : counted(overrun.substeps, "sub-step");
  if (overrun.iterations > 0) what += " of " + counted(overrun.iterations, "iteration");
  return what + " on " + counted(overrun.rows, "row") + of_bodies + " would need " +
         format_text("%.2g", overrun.work) + " operations" +
         (overrun.of_substep ? "" : " in a frame") + "; the budget is " +
         format_text("%.2g", overrun.budget);
}

std::string stop_text(const Scene& scene, const FrameReport& report) {
  switch (report.status) {
    case StepStatus::kOk:
      return "";
    case StepStatus::kNotFinite:
      if (report.failed_body < 0) return "not finite";
      return "not finite (" + scene.bodies[index(report.failed_body)].name + ")";
    case StepStatus::kTooManyContacts:
      return "more than " + std::to_string(std::llround(report.overrun.budget)) + " contacts or " +
             std::to_string(kMaxPairs) + " pairs of bodies near each other";
    case StepStatus::kOverBudget:
      return overrun_text(report.overrun);
    case StepStatus::kInvalid:
      return "the input of the simulator is invalid";
  }
  return "";  // not reached: the switch is exhaustive
}

}  // namespace substep
