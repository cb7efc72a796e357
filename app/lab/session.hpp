#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/lab/ball.hpp"
#include "app/lab/frame_slices.hpp"
#include "app/lab/history.hpp"
#include "app/lab/run_events.hpp"
#include "app/lab/timeline.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene.hpp"
#include "core/sim/simulator.hpp"

namespace substep {

/// Poses to draw: those of a state, or in between two of them.
struct Poses {
  std::vector<Vec3> x;
  std::vector<Quat> q;
};

/// A scene that became another one while it ran: a ball was thrown into it, an effect switched off.
struct SceneEdit {
  std::shared_ptr<const Scene> from;
  std::shared_ptr<const Scene> to;
  std::int64_t frame = 0;             // after which
  std::function<State(State)> carry;  // takes a state of `from` over to `to`
};

/// One scene running: simulator, judge, history, past and clock. Knows nothing of windows.
class Session {
 public:
  /// @param past_bytes how much memory the saved states may take
  explicit Session(std::shared_ptr<const Scene> scene, std::size_t past_bytes = Timeline::kBytes);

  /// Starts another scene with that scene's settings. Plays if this one was to.
  void load(std::shared_ptr<const Scene> scene);
  /// Back to the start of the scene as it was loaded. A run that failed while it played plays.
  void reset();

  /// Lets wall time pass: frames are taken while there is time for them. The time that one call can
  /// ask for is capped, so that a tab that slept does not come back to a backlog, and what does not
  /// fit into `budget` is dropped: the run is then slower than the wall, see pace(). A frame that
  /// takes longer continues in the next call.
  /// @param budget [s] @return frames taken
  int advance(double wall_dt, double budget = kSlice);
  /// One frame, whether it plays or not: what is left of the one that substep() began. Where the
  /// run is looked at in the past and nothing was changed since, the frame that followed then.
  void step();
  /// The same, by calls of advance() to come where it takes long.
  void request_step();
  /// The frame that advance() has begun, if it is open.
  [[nodiscard]] const FrameSlices& slices() const { return slices_; }
  /// One sub-step.
  void substep();
  /// Sub-steps that the frame begun by substep() still has; 0 between frames.
  [[nodiscard]] int substeps_left() const { return simulator_->substeps_left(); }

  /// The past: every frame, as far as memory goes. A run continued from any of them is the same bit
  /// for bit; later frames are discarded then.
  [[nodiscard]] const Timeline& timeline() const { return timeline_; }
  void go_to(std::size_t moment);
  /// To the frame before this one, or to the start of the one that substep() began.
  void step_back();
  /// To the last moment whose verdict holds, `seconds` or more before the run failed.
  void go_to_last_good(double seconds = 0.0);

  /// Holds a body. @param anchor where, in its frame [m]; @param target world [m]
  void grab(int body, const Vec3& anchor, const Vec3& target);
  void pull_to(const Vec3& target);  ///< world [m]
  void let_go() { hand_.reset(); }
  [[nodiscard]] const std::optional<Grab>& held() const { return hand_; }
  void throw_ball(const Ball& ball);
  /// From its next reset on the run follows these events, those of a link.
  void follow(std::vector<RunEvent> script);
  [[nodiscard]] const EventLog& log() const { return log_; }
  /// Goes on with some of the scene's effects switched off, or on again.
  void set_effects(const Effects& effects);
  /// The scene as it was loaded; scene() differs where a hand was in it.
  [[nodiscard]] const Scene& loaded() const { return *loaded_; }
  /// A run at the last edit of its scene, as a scene of its own.
  struct Edition {
    std::shared_ptr<const Scene> of;     // what the run is in since
    std::shared_ptr<const Scene> start;  // the same with the state that it had then
    std::int64_t frame = 0;              // of the run then
  };
  /// The run as it is now as a scene of its own, to be written to a file.
  [[nodiscard]] Scene as_scene() const;
  /// Of the scene that runs now; null where it is the loaded one.
  [[nodiscard]] const Edition* edition() const;
  /// Balls that were thrown and are still there.
  [[nodiscard]] std::size_t balls() const { return scene_->bodies.size() - loaded_->bodies.size(); }

  void play();
  /// Leaves a frame that has not ended: the run is where it began.
  void pause();
  /// Pauses without the user: at a failure, or while the past is shown. What runs next plays again.
  /// What is loaded next plays if this run did.
  void hold();
  void toggle() { playing_ ? pause() : play(); }
  [[nodiscard]] bool playing() const { return playing_; }
  /// The state is no longer finite: only a reset or an earlier frame leads on.
  [[nodiscard]] bool stopped() const { return report_.status != StepStatus::kOk; }

  [[nodiscard]] double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }
  /// Simulated time per wall time that was reached lately, 1 at full speed [-].
  [[nodiscard]] double pace() const { return pace_; }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  /// The scene without what was thrown into it.
  [[nodiscard]] const std::shared_ptr<const Scene>& loaded_scene() const { return loaded_; }
  /// At the end of the last frame, or sub-step where those are single.
  [[nodiscard]] const State& state() const { return slices_.state(*simulator_); }
  [[nodiscard]] const Settings& settings() const { return simulator_->settings(); }
  /// A frame that advance() has begun is restarted with them.
  void set_settings(const Settings& settings);
  [[nodiscard]] const FrameReport& report() const { return report_; }
  [[nodiscard]] const Verdict& verdict() const { return *verdict_; }
  /// Whether the last frame that was taken is the one that the run failed in.
  [[nodiscard]] bool just_failed() const { return just_failed_; }
  /// Whether the verdict says something: not at the start of a run, before its first frame.
  [[nodiscard]] bool judged() const {
    return timeline_.index() > 0 || !verdict_->holds() || verdict_->disturbed();
  }
  [[nodiscard]] const History& history() const { return history_; }
  /// What joints and contacts did in the last sub-step.
  [[nodiscard]] const ConstraintForces& forces() const { return forces_; }
  [[nodiscard]] std::uint64_t hash() const { return state_hash(state()); }
  /// Counts scenes loaded, so that a new one can be detected.
  [[nodiscard]] int generation() const { return generation_; }

  /// Poses at the accumulated wall time, between the last two frames: motion stays smooth at any
  /// speed and any refresh rate. Those of the state itself when paused.
  [[nodiscard]] const Poses& poses() const { return poses_; }
  /// How far the poses to draw are from the frame before (0) to the last one (1).
  [[nodiscard]] double between() const;
  /// Called after every frame: what runs beside this session keeps step with it. @return whether it
  /// has; where it has not, advance() takes no further frame in this call
  std::function<bool()> frame_taken;
  /// Called after the scene was edited, for the same to be done there.
  std::function<void(const SceneEdit&)> scene_edited;
  /// Where the tracked body was in the last frames, oldest first; empty where none is tracked.
  [[nodiscard]] const std::deque<Vec3>& trail() const { return trail_; }
  /// Wall times by stage, smoothed over about half a second: a browser's clock is coarse.
  [[nodiscard]] const StageTimes& times() const { return times_; }

 private:
  static constexpr std::size_t kTrail = 150;  // frames

  void restart();
  void make_simulator();
  void use_scene(std::shared_ptr<const Scene> scene);
  void go_on_in(Scene scene, std::function<State(State)> carry);
  void put_ball(const Ball& ball);
  void put_effects(const Effects& effects);
  void use_settings(const Settings& settings);
  void hold_body(const std::optional<Pull>& pull);
  void act(const RunEvent& event);
  bool step_in_past();
  void begin_frame();
  void take_frame();
  bool end_frame();
  bool run_slice(FrameSlices::Clock::time_point until);
  void come_between_frames();
  void forget_future();
  [[nodiscard]] Moment moment() const;
  void show_present();
  void update_poses();
  void extend_trail();
  void smooth_times();

  std::shared_ptr<const Scene> loaded_;
  std::shared_ptr<const Scene> scene_;  // what was loaded, and the balls
  std::vector<Edition> editions_;
  std::unique_ptr<Simulator> simulator_;
  std::unique_ptr<Verdict> verdict_;
  FrameReport report_;
  ConstraintForces forces_;
  History history_;
  Timeline timeline_;
  FrameSlices slices_;
  State substeps_from_;       // where the frame of single sub-steps began
  bool one_frame_ = false;    // is all that is to be taken
  std::optional<Grab> hand_;  // acts from the next frame on
  EventLog log_;
  Poses previous_;
  Poses poses_;
  std::deque<Vec3> trail_;
  StageTimes times_;
  double accumulator_ = 0.0;  // wall time not yet simulated, times speed [s]
  double speed_ = 1.0;
  double pace_ = 1.0;
  bool playing_ = false;
  bool resumes_ = false;  // it played until hold()
  bool just_failed_ = false;
  int generation_ = 0;
};

}  // namespace substep
