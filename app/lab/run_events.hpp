#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "app/lab/ball.hpp"
#include "core/model/effects.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// A hand on a body, and its current target.
struct Pull {
  int body = 0;
  Vec3 anchor = Vec3::Zero();  // body frame [m]
  Vec3 target = Vec3::Zero();  // world [m]
  friend bool operator==(const Pull&, const Pull&) = default;
};
struct LetGo {
  friend bool operator==(const LetGo&, const LetGo&) = default;
};

/// A user action, before the frame that follows `frame`.
struct RunEvent {
  std::int64_t frame = 0;
  std::variant<Ball, Effects, Pull, LetGo, Settings> what;
};

/// The target of a hand, rounded to 1/65536 m so that links stay short. Empty if it is not finite
/// or too far away.
std::optional<Vec3> hand_target(const Vec3& target);

/// All user actions of a run, to reproduce it bit for bit; links contain them. A run opened from a
/// link follows them as a script until the user throws, pulls or switches an effect. Settings that
/// the user changes override those of the script until the scene is reloaded.
class EventLog {
 public:
  /// Hand moves and settings beyond this number of events, more than fit a link, are not recorded.
  static constexpr std::size_t kMost = 4096;

  /// Clears the script, for another scene.
  void forget() { script_.clear(); }
  /// Call at the start of a run. @return scripted()
  const Settings* restart(const Settings& settings);
  /// The script's current settings, or null if it does not change any.
  [[nodiscard]] const Settings* scripted() const;
  /// Sets the script to follow from the next restart. @param settings initial settings
  void follow(std::vector<RunEvent> script, const Settings& settings);
  /// Call on a user action: ends the script.
  void take_over() { following_ = false; }
  /// Call when the user changes the settings.
  void choose(const Settings& settings);
  /// Seeks to a frame; later events are kept but not yet in effect.
  void go_to(std::int64_t frame);
  /// Discards the events after the current frame.
  void forget_future();

  void add(std::int64_t frame, const Ball& ball) { append({frame, ball}); }
  void add(std::int64_t frame, const Effects& effects) { append({frame, effects}); }
  /// Records the settings or the hand of the next frame if they changed.
  void note(std::int64_t frame, const Settings& settings);
  void note(std::int64_t frame, const std::optional<Pull>& hand);

  /// The script's next event if it is due before the next frame; it then counts as taken.
  const RunEvent* next(std::int64_t frame);
  [[nodiscard]] bool following() const { return following_; }

  /// Whether past and scripted events are settings only.
  [[nodiscard]] bool empty() const;
  /// Past events and the rest of the script; empty if some were not recorded.
  [[nodiscard]] std::optional<std::vector<RunEvent>> events() const;
  /// Settings at the start of the run.
  [[nodiscard]] const Settings& start() const { return start_; }
  [[nodiscard]] const std::optional<Pull>& hand() const { return hand_; }
  /// Balls thrown so far.
  [[nodiscard]] std::size_t balls() const;

 private:
  void append(RunEvent event);
  [[nodiscard]] std::span<const RunEvent> past() const { return {done_.data(), count_}; }
  void in_effect(const RunEvent& event);

  std::vector<RunEvent> done_;  // including later events that are not yet discarded
  std::size_t count_ = 0;       // number of past events in done_
  Settings start_;
  Settings settings_;         // in effect
  std::optional<Pull> hand_;  // in effect
  bool whole_ = true;
  std::vector<RunEvent> script_;
  Settings script_start_;
  std::size_t next_ = 0;  // index into script_
  bool following_ = false;
  bool own_settings_ = false;  // the user changed the settings; the script no longer does
};

}  // namespace substep
