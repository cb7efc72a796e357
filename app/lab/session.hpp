#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/lab/ball.hpp"
#include "app/lab/energy_account.hpp"
#include "app/lab/frame_slices.hpp"
#include "app/lab/history.hpp"
#include "app/lab/run_events.hpp"
#include "app/lab/timeline.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene.hpp"
#include "core/sim/simulator.hpp"

namespace substep {

/// Poses to draw: of a state, or interpolated between two.
struct Poses {
  std::vector<Vec3> x;
  std::vector<Quat> q;
};

/// A change of the scene during a run: a ball was thrown, an effect switched off.
struct SceneEdit {
  std::shared_ptr<const Scene> from;
  std::shared_ptr<const Scene> to;
  std::int64_t frame = 0;             // the frame after which it applies
  std::function<State(State)> carry;  // converts a state of `from` to `to`
};

/// One running scene: simulator, judge, history, timeline and clock. Independent of windows.
class Session {
 public:
  /// @param past_bytes memory limit of the saved states
  explicit Session(std::shared_ptr<const Scene> scene, std::size_t past_bytes = Timeline::kBytes);

  /// Starts another scene with that scene's settings. Keeps playing if this one was.
  void load(std::shared_ptr<const Scene> scene);
  /// Restarts the scene as loaded. A run that failed while playing resumes.
  void reset();

  /// Advances by wall time. The time per call is capped, so that a suspended tab has no backlog.
  /// Time that does not fit into `budget` is dropped: the run falls behind the wall clock, see
  /// pace(). A longer frame continues in the next call.
  /// @param budget [s] @return frames taken
  int advance(double wall_dt, double budget = kSlice);
  /// Takes one frame, paused or not, or completes the one that substep() began. In an unmodified
  /// past, moves to the next recorded frame.
  void step();
  /// Like step(), but a long frame is spread over the following calls of advance().
  void request_step();
  /// The frame in progress in advance(), if any.
  [[nodiscard]] const FrameSlices& slices() const { return slices_; }
  /// One sub-step.
  void substep();
  /// Remaining sub-steps of the frame begun by substep(); 0 between frames.
  [[nodiscard]] int substeps_left() const {
    return slices_.open() ? 0 : simulator_->substeps_left();
  }

  /// The past: every frame, within the memory limit. Continuing from one of them reproduces the run
  /// bit for bit and discards later frames.
  [[nodiscard]] const Timeline& timeline() const { return timeline_; }
  void go_to(std::size_t moment);
  /// Goes to the previous frame, or to the start of the one that substep() began.
  void step_back();
  /// Goes to the last moment with a good verdict at least `seconds` before the failure.
  void go_to_last_good(double seconds = 0.0);

  /// Grabs a body. @param anchor in the body frame [m]; @param target world [m]
  void grab(int body, const Vec3& anchor, const Vec3& target);
  void pull_to(const Vec3& target);  ///< world [m]
  void let_go() { hand_.reset(); }
  [[nodiscard]] const std::optional<Grab>& held() const { return hand_; }
  void throw_ball(const Ball& ball);
  /// Sets the events of a link as a script to follow from the next reset.
  void follow(std::vector<RunEvent> script);
  [[nodiscard]] const EventLog& log() const { return log_; }
  /// Switches effects of the scene off or on and continues.
  void set_effects(const Effects& effects);
  /// The scene as loaded; scene() differs after an edit.
  [[nodiscard]] const Scene& loaded() const { return *loaded_; }
  /// The run at an edit of its scene, as a scene of its own.
  struct Edition {
    std::shared_ptr<const Scene> of;     // the scene after the edit
    std::shared_ptr<const Scene> start;  // the same with the state at the edit
    std::int64_t frame = 0;              // of the run at the edit
  };
  /// The run in its current state as a scene, to be written to a file.
  [[nodiscard]] Scene as_scene() const;
  /// Of the current scene; null if it is the loaded one.
  [[nodiscard]] const Edition* edition() const;
  /// Number of thrown balls present.
  [[nodiscard]] std::size_t balls() const { return scene_->bodies.size() - loaded_->bodies.size(); }

  void play();
  /// Discards a frame in progress and restores its initial state.
  void pause();
  /// Pauses without user input: at a failure, or while the past is shown. The next run or scene
  /// resumes playing if this one did.
  void hold();
  void toggle() { playing_ ? pause() : play(); }
  [[nodiscard]] bool playing() const { return playing_; }
  /// The state is not finite: only a reset or an earlier frame can continue.
  [[nodiscard]] bool stopped() const { return report_.status != StepStatus::kOk; }

  [[nodiscard]] double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }
  /// Simulated time per wall time in the last seconds, 1 at full speed [-].
  [[nodiscard]] double pace() const { return asked_ > 0.0 ? achieved_ / asked_ : 1.0; }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  /// At the end of the last frame, or of the last single sub-step.
  [[nodiscard]] const State& state() const { return slices_.state(*simulator_); }
  [[nodiscard]] const Settings& settings() const { return simulator_->settings(); }
  /// Restarts the frame in progress, if any.
  void set_settings(const Settings& settings);
  [[nodiscard]] const FrameReport& report() const { return report_; }
  [[nodiscard]] const Verdict& verdict() const { return *verdict_; }
  /// Whether the run failed in the last frame taken.
  [[nodiscard]] bool just_failed() const { return just_failed_; }
  /// Whether the verdict is meaningful: false before the first frame of a run.
  [[nodiscard]] bool judged() const {
    return timeline_.index() > 0 || !verdict_->holds() || verdict_->disturbed();
  }
  [[nodiscard]] const History& history() const { return history_; }
  /// Work of the user in this run: throws, pulls, edits.
  [[nodiscard]] const EnergyAccount& account() const { return account_; }
  /// Joint and contact forces of the last sub-step.
  [[nodiscard]] const ConstraintForces& forces() const { return forces_; }
  [[nodiscard]] std::uint64_t hash() const { return state_hash(state()); }
  /// Incremented for each scene loaded.
  [[nodiscard]] int generation() const { return generation_; }

  /// Poses at the accumulated wall time, interpolated between the last two frames: motion is smooth
  /// at any speed and refresh rate. When paused, those of the state.
  [[nodiscard]] const Poses& poses() const { return poses_; }
  /// Interpolation factor of the poses: 0 previous frame, 1 last frame.
  [[nodiscard]] double between() const;
  /// Called after every frame, to advance runs that follow this one. @return whether they have
  /// completed it; if not, advance() takes no further frame in this call
  std::function<bool()> frame_taken;
  /// Called after an edit of the scene, to repeat it in runs that follow this one.
  std::function<void(const SceneEdit&)> scene_edited;
  /// Positions of the tracked body in the last frames, oldest first; empty if none is tracked.
  [[nodiscard]] const std::deque<Vec3>& trail() const { return trail_; }
  /// Wall times by stage, smoothed over about half a second because browser clocks are coarse.
  [[nodiscard]] const StageTimes& times() const { return times_; }

 private:
  static constexpr std::size_t kTrail = 150;  // frames

  void restart();
  void make_simulator();
  void use_scene(std::shared_ptr<const Scene> scene);
  void continue_in(Scene scene, std::function<State(State)> carry);
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
  void finish_partial_frame();
  void forget_future();
  [[nodiscard]] Moment moment() const;
  void show_present();
  void update_poses();
  void extend_trail();
  void smooth_times();
  void note_pace(double wall_dt, double achieved);

  std::shared_ptr<const Scene> loaded_;
  std::shared_ptr<const Scene> scene_;  // the loaded one with edits
  std::vector<Edition> editions_;
  std::unique_ptr<Simulator> simulator_;
  std::unique_ptr<Verdict> verdict_;
  FrameReport report_;
  ConstraintForces forces_;
  History history_;
  EnergyAccount account_;
  Timeline timeline_;
  FrameSlices slices_;
  State substeps_from_;         // start of the frame taken in single sub-steps
  bool one_frame_ = false;      // only one frame is to be taken
  std::optional<Grab> hand_;    // takes effect with the next frame
  bool hand_in_frame_ = false;  // a hand pulled in a sub-step of the frame in progress
  EventLog log_;
  Poses previous_;
  Poses poses_;
  std::deque<Vec3> trail_;
  StageTimes times_;
  double accumulator_ = 0.0;  // wall time not yet simulated, times speed [s]
  double speed_ = 1.0;
  double asked_ = 0.0;     // simulated time that the wall time of the last seconds asked for [s]
  double achieved_ = 0.0;  // of it, what was simulated [s]
  bool playing_ = false;
  bool resumes_ = false;  // was playing before hold()
  bool just_failed_ = false;
  int generation_ = 0;
};

}  // namespace substep
