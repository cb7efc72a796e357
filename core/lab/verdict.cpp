#include "core/lab/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/lab/stop_text.hpp"
#include "core/model/format_text.hpp"

namespace substep {

namespace {

using What = Exceeded::What;

/// "joint gap 0.13 m > 0.1 m (link_3)"
std::string text_of(const Exceeded& e) {
  const char* unit = e.what == What::kEnergyGain ? "J" : "m";
  const char* what = e.what == What::kJointGap     ? "joint gap"
                     : e.what == What::kEnergyGain ? "energy gain"
                                                   : "moved";
  const std::string text = format_text("%s %.4g %s > %.4g %s", what, e.value, unit, e.limit, unit);
  return e.name.empty() ? text : text + " (" + e.name + ")";
}

}  // namespace

Verdict::Verdict(const Scene& scene, const State& state, const FrameReport& start)
    : energy_at_start_(start.energy) {
  if (start.status == StepStatus::kInvalid || !scene.criteria.displacement) return;
  watched_start_ = state.x[index(scene.criteria.displacement->body)];
}

void Verdict::add(const Scene& scene, const State& state, const FrameReport& report) {
  if (failed_) return;
  const Criteria& criteria = scene.criteria;
  std::string why = stop_text(scene, report);
  // The first criterion exceeded is the reason; all contribute to utilisation_.
  const auto judge = [&](What what, double value, double limit, const std::string& name) {
    utilisation_ = std::max(utilisation_, value / limit);
    if (!(value > limit) || !why.empty()) return;
    exceeded_ = {what, value, limit, name};
    why = text_of(*exceeded_);
  };
  stopped_ = report.status != StepStatus::kOk;
  if (report.joint_gap_joint >= 0) {
    const auto joint = index(report.joint_gap_joint);
    judge(What::kJointGap, report.joint_gap, criteria.joint_gap, base(scene.joints[joint]).name);
  }
  // An invalid scene has no state.
  const bool judged = !disturbed_ && report.status != StepStatus::kInvalid;
  if (judged && criteria.energy_gain) {
    judge(What::kEnergyGain, report.energy - energy_at_start_, *criteria.energy_gain, {});
  }
  if (judged && criteria.displacement) {
    const auto body = index(criteria.displacement->body);
    judge(What::kMoved, (state.x[body] - watched_start_).norm(), criteria.displacement->distance,
          scene.bodies[body].name);
  }
  if (why.empty()) return;
  failed_ = true;
  failed_at_ = report.time;
  text_ = format_text("fails at %.3f s: ", failed_at_) + why;
}

void Verdict::disturb(double time) {
  if (failed_ || disturbed_) return;
  disturbed_ = true;
  text_ = format_text("disturbed at %.2f s", time);
}

}  // namespace substep
