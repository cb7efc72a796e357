#include "core/lab/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/forces/applied_forces.hpp"
#include "core/lab/stop_text.hpp"
#include "core/model/format_text.hpp"
#include "core/model/validate.hpp"
#include "core/stepping/compliance.hpp"

namespace substep {

namespace {

using What = Exceeded::What;

/// "joint gap 0.13 m > 0.1 m (link_3)"
std::string text_of(const Exceeded& e) {
  if (e.what == What::kPassage) return "passed through each other: " + e.name;
  const char* unit = e.what == What::kEnergyGain ? "J" : "m";
  const char* what = e.what == What::kJointGap     ? "joint gap"
                     : e.what == What::kEnergyGain ? "energy gain"
                     : e.what == What::kOverlap    ? "overlap"
                                                   : "moved";
  const std::string text = format_text("%s %.4g %s > %.4g %s", what, e.value, unit, e.limit, unit);
  return e.name.empty() ? text : text + " (" + e.name + ")";
}

constexpr double kPeriod = 0.5;          // [s]
constexpr double kMostSustained = 0.01;  // of the energy exchanged
constexpr double kMostNow = 0.1;
constexpr double kMostAtFirst = 0.25;
constexpr double kRoundedEnergy = 1e-12;  // of the energy of a body's size per frame
constexpr double kNoise = 1e-4;       // of the weight times the size: overlaps that contacts allow
constexpr double kMostInside = 0.25;  // of the width of the smaller body
constexpr double kParted = 1e-3;      // of that width: an overlap that is left

std::string names_of(const Scene& scene, int a, int b) {
  return scene.bodies[index(a)].name + ", " + scene.bodies[index(b)].name;
}

}  // namespace

EnergyWatch::EnergyWatch(const Scene& scene, const FrameReport& start)
    : lowest_(start.energy),
      period_lowest_(lowest_),
      kinetic_(start.kinetic),
      potential_{start.potential, start.potential},
      elastic_{start.elastic, start.elastic},
      parts_(start.inside > kParted) {
  if (!is_runnable(scene)) return;
  double weight = 0.0;
  int moving = 0;
  for (const Body& body : scene.bodies) {
    if (body.is_static) continue;
    const double size = radius_around(body.shape);
    const double speed = size / scene.frame;
    const double gravity = scene.effects.gravity ? scene.gravity.norm() : 0.0;
    const double force = body.mass * gravity + (scene.effects.external ? body.force.norm() : 0.0);
    besides_ += kNoise * force * size + kRoundedEnergy * body.mass * speed * speed;
    weight += force;
    ++moving;
  }
  most_parting_ = weight * start.penetration * moving;
}

void EnergyWatch::Span::add(double value) {
  least = std::min(least, value);
  most = std::max(most, value);
}

void EnergyWatch::add(const FrameReport& report) {
  if (parts_) parting_ = std::min(parting_ + report.parting, most_parting_);
  parts_ = parts_ && report.inside > kParted;
  const double energy = report.energy - parting_;
  stiff_ = std::max(stiff_, report.elastic - report.springs);
  const auto period = static_cast<std::int64_t>(report.time / kPeriod);
  if (period != period_) {
    sustained_ = std::max(sustained_, period_lowest_ - lowest_);
    lowest_ = std::min(lowest_, period_lowest_);
    period_ = period;
    period_lowest_ = energy;
  }
  period_lowest_ = std::min(period_lowest_, energy);
  rise_ = energy - std::min(lowest_, period_lowest_);
  kinetic_ = std::max(kinetic_, report.kinetic);
  potential_.add(report.potential);
  elastic_.add(report.elastic);
}

EnergyWatch::Rise EnergyWatch::worst() const {
  const double scale = std::max({kinetic_, potential_.width(), elastic_.width()});
  const double besides = besides_ + stiff_;
  const Rise now{rise_, (period_ == 0 ? kMostAtFirst : kMostNow) * scale + besides};
  const Rise sustained{sustained_, kMostSustained * scale + besides};
  return now.rise * sustained.limit > sustained.rise * now.limit ? now : sustained;
}

Verdict::Verdict(const Scene& scene, const State& state, const FrameReport& start)
    : refused_(!is_runnable(scene) || !fits(state, scene)),
      energy_at_start_(start.energy),
      inside_at_start_(start.inside) {
  if (refused_ || start.status == StepStatus::kInvalid) return;
  judges_overlaps_ = !scene.criteria.energy_gain && !is_soft(scene.contact);
  if (!scene.criteria.energy_gain && !is_driven(scene)) energy_.emplace(scene, start);
  if (scene.effects.contact) passages_.emplace(scene, state);
  if (!scene.criteria.displacement) return;
  watched_start_ = state.x[index(scene.criteria.displacement->body)];
}

void Verdict::add(const Scene& scene, const State& state, const FrameReport& report) {
  if (failed_) return;
  const Criteria& criteria = scene.criteria;
  if (refused_ && report.status != StepStatus::kInvalid) {
    FrameReport invalid;
    invalid.status = StepStatus::kInvalid;
    invalid.time = report.time;
    add(scene, state, invalid);
    return;
  }
  std::string why = stop_text(scene, report);
  // The first criterion exceeded is the reason; all contribute to utilisation_.
  const auto judge = [&](What what, double value, double limit, const std::string& name,
                         int body = -1) {
    utilisation_ = std::max(utilisation_, value / limit);
    if (!(value > limit) || !why.empty()) return;
    exceeded_ = {what, value, limit, name, body};
    why = text_of(*exceeded_);
  };
  stopped_ = report.status != StepStatus::kOk;
  if (report.torn_joint >= 0) {
    const JointBase& joint = base(scene.joints[index(report.torn_joint)]);
    const double limit = largest_gap(scene, joint);
    judge(What::kJointGap, report.torn * limit, limit, joint.name);
  }
  // An invalid scene has no state.
  const bool judged = !disturbed_ && report.status != StepStatus::kInvalid;
  if (judged && energy_) {
    energy_->add(report);
    const EnergyWatch::Rise worst = energy_->worst();
    judge(What::kEnergyGain, worst.rise, worst.limit, {});
  } else if (judged && criteria.energy_gain) {
    judge(What::kEnergyGain, report.energy - energy_at_start_, *criteria.energy_gain, {});
  }
  if (judged && passages_) {
    if (const auto passage = passages_->add(scene, state)) {
      const int moves = is_fixed(scene, passage->body) ? passage->through : passage->body;
      judge(What::kPassage, passage->depth, 0.0, names_of(scene, passage->body, passage->through),
            moves);
    }
  }
  if (judged && judges_overlaps_) {
    inside_at_start_ = std::min(inside_at_start_, report.inside);
    if (report.inside_a >= 0) {
      const double width = smaller_width(scene, report.inside_a, report.inside_b);
      const bool a_moves = !is_fixed(scene, report.inside_a);
      judge(What::kOverlap, report.inside * width, std::max(inside_at_start_, kMostInside) * width,
            names_of(scene, report.inside_a, report.inside_b),
            a_moves ? report.inside_a : report.inside_b);
    }
  }
  if (judged && criteria.displacement) {
    const auto body = index(criteria.displacement->body);
    judge(What::kMoved, (state.x[body] - watched_start_).norm(), criteria.displacement->distance,
          scene.bodies[body].name, criteria.displacement->body);
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
