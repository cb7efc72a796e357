#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "app/lab/ball.hpp"
#include "core/model/effects.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// A hand on a body, or where it pulls to now.
struct Pull {
  int body = 0;
  Vec3 anchor = Vec3::Zero();  // body frame [m]
  Vec3 target = Vec3::Zero();  // world [m]
  friend bool operator==(const Pull&, const Pull&) = default;
};
struct LetGo {
  friend bool operator==(const LetGo&, const LetGo&) = default;
};

/// What a person did to a run, before the frame that follows `frame`.
struct RunEvent {
  std::int64_t frame = 0;
  std::variant<Ball, Effects, Pull, LetGo, Settings> what;
};

/// Where a hand may pull to: rounded to 1/65536 m, so that a link holds a pull in little room.
/// Nothing where it is not finite or too far away.
std::optional<Vec3> hand_target(const Vec3& target);

/// Everything that was done to a run, to do it again, bit for bit: what a link holds. The run of
/// such a link follows a script until a person throws, pulls or switches an effect. Settings that
/// the person changes override those of the script until the scene is loaded again.
class EventLog {
 public:
  /// More moves of the hand than any link holds are not noted.
  static constexpr std::size_t kMost = 4096;

  /// Another scene: nothing to follow.
  void forget() { script_.clear(); }
  /// A run begins at its start. @return scripted()
  const Settings* restart(const Settings& settings);
  /// The settings that the script has now, or null where it does not change any.
  [[nodiscard]] const Settings* scripted() const;
  /// From its next start on the run follows these, in order. @param settings that it starts with
  void follow(std::vector<RunEvent> script, const Settings& settings);
  /// A person acts: what the script had left is dropped.
  void take_over() { following_ = false; }
  /// A person sets these.
  void choose(const Settings& settings);
  /// The run is looked at as it was at this frame: later events did not happen yet.
  void go_to(std::int64_t frame);
  /// It continues from there.
  void forget_future();

  void add(std::int64_t frame, const Ball& ball) { append({frame, ball}); }
  void add(std::int64_t frame, const Effects& effects) { append({frame, effects}); }
  /// What the next frame is taken with; noted where it differs from the frame before.
  void note(std::int64_t frame, const Settings& settings);
  void note(std::int64_t frame, const std::optional<Pull>& hand);

  /// The next event of the script if it belongs before the next frame; it then counts as taken.
  const RunEvent* next(std::int64_t frame);
  [[nodiscard]] bool following() const { return following_; }

  /// Whether a hand was in the run, or will be.
  [[nodiscard]] bool empty() const;
  /// What was done and what the script will do; nothing where it was too much to be noted.
  [[nodiscard]] std::optional<std::vector<RunEvent>> events() const;
  /// That the run began with.
  [[nodiscard]] const Settings& start() const { return start_; }
  [[nodiscard]] const std::optional<Pull>& hand() const { return hand_; }
  /// Balls thrown so far.
  [[nodiscard]] std::size_t balls() const;

 private:
  void append(RunEvent event);
  void in_effect(const RunEvent& event);

  std::vector<RunEvent> done_;  // and after those, in a future that is not forgotten yet
  std::size_t count_ = 0;       // done
  Settings start_;
  Settings settings_;         // in effect
  std::optional<Pull> hand_;  // in effect
  bool whole_ = true;
  std::vector<RunEvent> script_;
  Settings script_start_;
  std::size_t next_ = 0;  // of the script
  bool following_ = false;
  bool own_settings_ = false;  // a person changed them: the script no longer does
};

}  // namespace substep
