#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "app/history.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene.hpp"
#include "core/sim/simulator.hpp"

namespace substep {

/// Poses to draw: those of a state, or in between two of them.
struct Poses {
  std::vector<Vec3> x;
  std::vector<Quat> q;
};

/// One scene running: simulator, judge, history and clock. Knows nothing of windows.
class Session {
 public:
  explicit Session(std::shared_ptr<const Scene> scene);

  /// Starts another scene with the settings that it asks for. Keeps playing if it was.
  void load(std::shared_ptr<const Scene> scene);
  void reset();

  /// Lets wall time pass: whole frames are taken while there is time for them. The time that one
  /// call can ask for is capped, so that a tab that slept does not come back to a backlog, and
  /// what does not fit into `budget` is dropped: the run is then slower than the wall, see pace().
  /// @return frames taken
  int advance(double wall_dt, double budget = 0.025);
  /// One frame now, whether it plays or not.
  void step();

  void play() { playing_ = !stopped(); }
  void pause() { playing_ = false; }
  void toggle() { playing_ ? pause() : play(); }
  [[nodiscard]] bool playing() const { return playing_; }
  /// The state stopped being finite: only a reset goes on.
  [[nodiscard]] bool stopped() const { return report_.status != StepStatus::kOk; }

  [[nodiscard]] double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }
  /// Simulated time per wall time that was reached lately, 1 at full speed [-].
  [[nodiscard]] double pace() const { return pace_; }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  [[nodiscard]] const State& state() const { return simulator_->state(); }
  [[nodiscard]] const Settings& settings() const { return simulator_->settings(); }
  void set_settings(const Settings& settings) { simulator_->set_settings(settings); }
  [[nodiscard]] const FrameReport& report() const { return report_; }
  [[nodiscard]] const Verdict& verdict() const { return *verdict_; }
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] std::uint64_t hash() const { return state_hash(state()); }
  /// Counts scenes loaded, for those who must notice a new one.
  [[nodiscard]] int generation() const { return generation_; }

  /// Poses at the accumulated wall time, between the last two frames: motion stays smooth at any
  /// speed and any refresh rate. Those of the state itself when paused.
  [[nodiscard]] const Poses& poses() const { return poses_; }
  /// How far the poses to draw are from the frame before (0) to the last one (1).
  [[nodiscard]] double between() const;
  /// Called after every frame: what runs beside this session keeps step with it.
  std::function<void()> frame_taken;
  /// Where the tracked body was in the last frames, oldest first; empty where none is tracked.
  [[nodiscard]] const std::deque<Vec3>& trail() const { return trail_; }
  /// Wall times by stage, smoothed over about half a second: a browser's clock is coarse.
  [[nodiscard]] const StageTimes& times() const { return times_; }

 private:
  void restart();
  void take_frame();
  void update_poses();
  void extend_trail();
  void smooth_times();

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Simulator> simulator_;
  std::unique_ptr<Verdict> verdict_;
  FrameReport report_;
  History history_;
  Poses previous_;
  Poses poses_;
  std::deque<Vec3> trail_;
  StageTimes times_;
  double accumulator_ = 0.0;  // wall time not yet simulated, times speed [s]
  double speed_ = 1.0;
  double pace_ = 1.0;
  bool playing_ = false;
  int generation_ = 0;
};

}  // namespace substep
