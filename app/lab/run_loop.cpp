#include "app/lab/run_loop.hpp"

#include <algorithm>
#include <cmath>

namespace substep {
namespace {

constexpr double kSlowMotion = 0.25;  // speed [-]
constexpr double kBefore = 0.4;       // slow motion begins this long before a known failure [s]
constexpr double kAftermath = 0.9;    // still shown in slow motion [s]

// The first failure among the run and those compared with it.
std::optional<double> first_failure(const Lab& lab) {
  std::optional<double> first;
  const auto add = [&](const Verdict& verdict) {
    if (!verdict.holds())
      first = std::min(first.value_or(verdict.failed_at()), verdict.failed_at());
  };
  add(lab.session.verdict());
  for (const Compare::Run& run : lab.compare.runs()) {
    if (run.verdict) add(*run.verdict);
  }
  return first;
}

RunLoop::Pass pass_of(const History& history, const Verdict& verdict) {
  RunLoop::Pass pass;
  pass.stable = verdict.holds();
  pass.failed_at = verdict.failed_at();
  pass.exceeded = verdict.exceeded();
  if (history.size() == 0) return pass;
  pass.drift = static_cast<double>(history[Channel::kDrift].back());
  const Extent n = history.samples(Channel::kSubsteps).extent(0, history.size());
  pass.least_n = static_cast<int>(n.low);
  pass.most_n = static_cast<int>(n.high);
  for (const float taken : history[Channel::kSubsteps]) pass.substeps += std::lround(taken);
  return pass;
}

// Without display-only settings.
Settings settings_of(const Session& session) {
  Settings settings = session.settings();
  settings.watch_stiffness = false;
  return settings;
}

}  // namespace

void RunLoop::begin(Lab& lab, const Plan& plan) {
  if (!open()) speed_ = lab.session.speed();
  plan_ = plan;
  slow_ = rested_ = failed_ = stale_ = false;
  failure_.reset();
  settings_ = settings_of(lab.session);
  load_ = lab.load;
  whole_ = true;
  outcome_ = {};
  lab.hold_at_failure = false;
  lab.compare.past_failure = true;
  lab.session.set_speed(speed_);
  set_slow(lab, is_slow_at(lab.session.state().time));
}

void RunLoop::end(Lab& lab) {
  if (!open()) return;
  plan_.reset();
  lab.hold_at_failure = true;
  lab.compare.past_failure = false;
  lab.session.set_speed(speed_);
}

bool RunLoop::is_slow_at(double time) const {
  if (time < plan_->slow_until) return true;
  return failure_ && time > *failure_ - kBefore && time < *failure_ + kAftermath;
}

// Only on a change: in between, the user may choose the speed.
void RunLoop::set_slow(Lab& lab, bool slow) {
  if (slow == slow_) return;
  slow_ = slow;
  if (slow) speed_ = lab.session.speed();
  lab.session.set_speed(slow ? std::min(speed_, kSlowMotion) : speed_);
}

void RunLoop::start_again(Lab& lab) {
  if (!failed_) failure_.reset();
  failed_ = rested_ = stale_ = false;
  whole_ = true;
  const bool stopped = lab.session.stopped();
  lab.reset();
  if (stopped) lab.session.play();
}

void RunLoop::observe(const Lab& lab) {
  const Settings now = settings_of(lab.session);
  if (now != settings_ || load_ != lab.load) {
    settings_ = now;
    load_ = lab.load;
    outcome_ = {};
    whole_ = lab.session.state().frame == 0;
    stale_ = !lab.session.verdict().holds();
  }
  if (lab.session.state().frame == 0) {  // it was reset
    whole_ = true;
    rested_ = stale_ = false;
  }
  if (const auto failure = first_failure(lab)) {
    failure_ = failure;
    failed_ = true;
  }
  const Verdict& verdict = lab.session.verdict();
  if (whole_ && !verdict.holds()) conclude(lab, Outcome::Kind::kFailed, verdict.failed_at());
}

void RunLoop::conclude(const Lab& lab, Outcome::Kind kind, double time) {
  outcome_ = {kind, time, pass_of(lab.session.history(), lab.session.verdict()), {}};
  for (const Compare::Run& run : lab.compare.runs()) {
    if (run.verdict) outcome_.beside.push_back(pass_of(run.history, *run.verdict));
  }
}

void RunLoop::follow(Lab& lab, bool repeats) {
  if (!open()) return;
  observe(lab);
  const bool stopped = lab.session.stopped();
  if (!lab.session.playing() && !stopped) return;
  const Verdict& verdict = lab.session.verdict();
  const double end = verdict.holds() ? plan_->end : verdict.failed_at() + kAftermath;
  if (lab.session.state().time >= end || stopped || stale_) {
    if (whole_ && verdict.holds()) conclude(lab, Outcome::Kind::kStable, plan_->end);
    if (!repeats && !stale_ && !rested_) {
      rested_ = true;
      return lab.session.pause();
    }
    if (!repeats && !stale_ && stopped) return;
    start_again(lab);
  }
  set_slow(lab, is_slow_at(lab.session.state().time));
}

}  // namespace substep
