#include "app/lab/run_events.hpp"

#include <algorithm>
#include <utility>

#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr double kGrid = 65536.0;  // [1/m]

bool is_settings(const RunEvent& event) { return std::holds_alternative<Settings>(event.what); }

bool is_hand(const RunEvent& event) {
  return std::holds_alternative<Pull>(event.what) || std::holds_alternative<LetGo>(event.what);
}

bool has_settings(const std::vector<RunEvent>& events) {
  return std::any_of(events.begin(), events.end(), is_settings);
}

/// Whether K is evaluated for display does not change the motion.
bool same_motion(Settings a, const Settings& b) {
  a.watch_stiffness = b.watch_stiffness;
  return a == b;
}

auto first_at(const std::vector<RunEvent>& events, std::int64_t frame) {
  return std::lower_bound(events.begin(), events.end(), frame,
                          [](const RunEvent& e, std::int64_t f) { return e.frame < f; });
}

}  // namespace

std::optional<Vec3> hand_target(const Vec3& target) {
  const auto outside = [](double x) { return !kPositionRange.contains(x); };
  if (std::any_of(target.begin(), target.end(), outside)) return std::nullopt;
  return Vec3((kGrid * target).array().round() / kGrid);
}

void EventLog::choose(const Settings& settings) {
  own_settings_ = own_settings_ || (following_ && !same_motion(settings, settings_));
}

const Settings* EventLog::scripted() const {
  return following_ && !own_settings_ && has_settings(script_) ? &settings_ : nullptr;
}

const Settings* EventLog::restart(const Settings& settings) {
  done_.clear();
  count_ = 0;
  hand_.reset();
  whole_ = true;
  next_ = 0;
  following_ = !script_.empty();
  start_ = settings_ = scripted() != nullptr ? script_start_ : settings;
  return scripted();
}

void EventLog::follow(std::vector<RunEvent> script, const Settings& settings) {
  script_ = std::move(script);
  script_start_ = settings;
  own_settings_ = following_ = false;
}

void EventLog::go_to(std::int64_t frame) {
  count_ = static_cast<std::size_t>(first_at(done_, frame) - done_.begin());
  settings_ = start_;
  hand_.reset();
  for (const RunEvent& event : past()) in_effect(event);
  next_ = static_cast<std::size_t>(first_at(script_, frame) - script_.begin());
}

void EventLog::forget_future() { done_.resize(count_); }

void EventLog::in_effect(const RunEvent& event) {
  if (const auto* settings = std::get_if<Settings>(&event.what)) settings_ = *settings;
  if (const auto* pull = std::get_if<Pull>(&event.what)) hand_ = *pull;
  if (std::holds_alternative<LetGo>(event.what)) hand_.reset();
}

// If two apply to the same frame, which was begun twice, the later one counts.
void EventLog::append(RunEvent event) {
  forget_future();
  in_effect(event);
  const auto replaces = [&](const RunEvent& last) {
    return last.frame == event.frame &&
           ((is_hand(last) && is_hand(event)) || (is_settings(last) && is_settings(event)));
  };
  if (!done_.empty() && replaces(done_.back())) {
    done_.back() = std::move(event);
  } else if (done_.size() < kMost || !(is_hand(event) || is_settings(event))) {
    done_.push_back(std::move(event));
  } else {
    whole_ = false;
  }
  count_ = done_.size();
}

void EventLog::note(std::int64_t frame, const Settings& settings) {
  if (same_motion(settings, settings_)) return;
  if (frame == 0 && done_.empty()) {
    start_ = settings_ = settings;
  } else {
    append({frame, settings});
  }
}

void EventLog::note(std::int64_t frame, const std::optional<Pull>& hand) {
  if (hand == hand_) return;
  if (hand) {
    append({frame, *hand});
  } else {
    append({frame, LetGo{}});
  }
}

const RunEvent* EventLog::next(std::int64_t frame) {
  if (!following_) return nullptr;
  while (next_ < script_.size() && script_[next_].frame <= frame) {
    const RunEvent& event = script_[next_++];
    if (!is_settings(event)) return &event;
    if (own_settings_) continue;
    append({frame, std::get<Settings>(event.what)});
    return &event;
  }
  return nullptr;
}

std::optional<std::vector<RunEvent>> EventLog::events() const {
  if (!whole_) return std::nullopt;
  std::vector<RunEvent> all(past().begin(), past().end());
  for (std::size_t i = next_; following_ && i < script_.size(); ++i) {
    if (!own_settings_ || !is_settings(script_[i])) all.push_back(script_[i]);
  }
  return all;
}

bool EventLog::empty() const {
  return std::all_of(past().begin(), past().end(), is_settings) &&
         (!following_ || std::all_of(script_.begin(), script_.end(), is_settings));
}

std::size_t EventLog::balls() const {
  return static_cast<std::size_t>(std::count_if(
      past().begin(), past().end(),
      [](const RunEvent& event) { return std::holds_alternative<Ball>(event.what); }));
}

}  // namespace substep
