// The past of a run: seeking and continuing from it.

#include <algorithm>

#include "app/lab/session.hpp"

namespace substep {

void Session::go_to(std::size_t index) {
  hold();
  hand_.reset();
  timeline_.go_to(index);
  const Moment& m = timeline_.now();
  use_scene(m.scene);
  simulator_->set_state(m.state);
  report_ = m.report;
  forces_ = m.forces;
  account_ = m.account;
  *verdict_ = m.verdict;
  log_.go_to(m.state.frame);
  if (log_.following()) hold_body(log_.hand());
  if (const Settings* scripted = log_.scripted()) use_settings(*scripted);
  trail_.clear();
  if (scene_->criteria.track) {
    const auto tracked = static_cast<std::size_t>(*scene_->criteria.track);
    const std::size_t first = timeline_.index() - std::min(timeline_.index(), kTrail - 1);
    for (std::size_t i = first; i <= timeline_.index(); ++i) {
      trail_.push_back(timeline_[i].state.x[tracked]);
    }
  }
  show_present();
}

void Session::step_back() {
  const bool within = substeps_left() > 0 || stopped();
  const std::size_t i = timeline_.index();
  go_to(within || i == 0 ? i : i - 1);
}

void Session::go_to_last_good(double seconds) {
  std::size_t i =
      timeline_.at_time((verdict_->holds() ? state().time : verdict_->failed_at()) - seconds);
  while (i > 0 && !timeline_[i].verdict.holds()) --i;
  go_to(i);
}

// Continuing from a past moment discards the later frames.
void Session::forget_future() {
  log_.forget_future();
  if (timeline_.at_end()) return;
  timeline_.cut();
  history_.cut(timeline_.now().state.time);
}

// In the past: moves to the next recorded frame.
bool Session::step_in_past() {
  const std::size_t next = timeline_.index() + 1;
  if (timeline_.at_end() || held() || substeps_left() > 0) return false;
  if (timeline_[next].settings != settings()) return false;
  go_to(next);
  return true;
}

}  // namespace substep
