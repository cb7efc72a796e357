#include "app/lab/heavy_start.hpp"

#include <algorithm>
#include <cmath>

#include "app/lab/frame_slices.hpp"
#include "app/text/format.hpp"
#include "core/lab/stop_text.hpp"

namespace substep {
namespace {

constexpr double kMost = 3e8;       // per frame [operations]
constexpr double kPerSecond = 6e8;  // approximately, of a browser on a laptop [operations/s]

std::string seconds_text(double seconds) {
  return seconds < 10.0 ? plain_number(std::round(seconds)) + " s"
                        : plain_number(10.0 * std::round(0.1 * seconds)) + " s";
}

}  // namespace

std::string heavy_start(const std::shared_ptr<const Scene>& scene, const Settings& settings) {
  Simulator beside(scene);
  beside.set_budget(kWindowBudget);
  beside.set_settings(settings);
  const FrameReport report = beside.substep();
  if (report.status == StepStatus::kOverBudget || report.status == StepStatus::kTooManyContacts) {
    return "It would stop at once: " + stop_text(*scene, report) + ".";
  }
  const int substeps = 1 + beside.substeps_left();
  const auto solves = static_cast<double>(std::max<std::int64_t>(1, report.work.solves));
  const double work = static_cast<double>(report.work.flops) / solves * substeps;
  if (work <= kMost) return "";
  return "A frame takes " + grouped(substeps) + (substeps == 1 ? " sub-step" : " sub-steps") +
         " and about " + seconds_text(std::max(1.0, work / kPerSecond)) +
         ". The window stays responsive, and Esc cancels a frame.";
}

}  // namespace substep
