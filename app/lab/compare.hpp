#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/lab/overrides.hpp"
#include "app/lab/session.hpp"

namespace substep {

/// Cost of a run since the comparison began.
struct Cost {
  std::int64_t frames = 0;
  std::int64_t substeps = 0;
  double seconds = 0.0;  // computing time
};

/// When a run first diverged from the reference run: a body farther away than the threshold.
struct Divergence {
  double time = 0.0;  // [s]
  int body = 0;
  double distance = 0.0;  // [m]
};

/// Other methods on the same scene and clock: each of them takes every frame of the session, from
/// the same initial state. User actions apply to all runs: a hand pulls each run's own body to the
/// same place, a ball is thrown into each.
class Compare {
 public:
  static constexpr double kThreshold = 0.01;  // [m]

  /// One of the other methods.
  struct Run {
    Overrides overrides;
    std::shared_ptr<const Scene> scene;  // the session's, or an earlier version of it
    std::unique_ptr<Simulator> simulator;
    std::optional<Verdict> verdict;
    FrameReport report;
    History history;
    EnergyAccount account;
    Poses poses;  // to draw, interpolated like the session's
    Cost cost;
    std::optional<Divergence> divergence;

   private:
    friend class Compare;
    FrameSlices slices;
    Poses previous;
    struct Checkpoint {
      std::shared_ptr<const Scene> scene;
      State state;
      Verdict verdict;
      Cost cost;
      EnergyAccount account;
    };
    std::vector<Checkpoint> checkpoints;  // oldest first
  };

  /// Whether runs continue after a failure. Otherwise they stay at the frame that failed, because
  /// the motion after a failure is not physical.
  bool past_failure = false;

  [[nodiscard]] bool open() const { return !runs_.empty(); }
  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  /// The overrides of all runs.
  [[nodiscard]] std::vector<Overrides> overrides() const;
  /// Cost of the session since the comparison began.
  [[nodiscard]] Cost cost(const Session& session) const;

  /// Runs these beside the session, from its current state. An empty list closes the comparison.
  void start(const Session& session, std::vector<Overrides> runs);
  void close() { runs_.clear(); }
  /// Restarts from the session's current state with the same methods.
  void restart(const Session& session);
  /// Adds or removes a run, and restarts all of them.
  void add(const Session& session, Overrides one);
  void remove(const Session& session, std::size_t index);
  /// Changes the method of a run without restarting it.
  void change(const Session& session, std::size_t index, const Settings& settings);

  /// Takes the frame that the session has just taken, within one slice of time; follow() continues
  /// it.
  /// @return whether all runs have completed the frame
  bool take_frame(const Session& session);
  /// Whether a run has not reached the session's frame yet.
  [[nodiscard]] bool behind(const Session& session) const;
  /// Applies an edit of the session's scene to the other runs.
  void edit(const Session& session, const SceneEdit& edit);
  /// Call once per drawn frame: follows seeks and changes of the session, within one slice of time,
  /// and updates the poses.
  void follow(const Session& session);

  /// The session's settings with the overrides applied.
  [[nodiscard]] static Settings settings_of(const Overrides& overrides, const Settings& session);

 private:
  /// A hand on a body from a frame on, or its release.
  struct Hold {
    std::int64_t frame = 0;
    std::optional<Grab> grab;
  };

  [[nodiscard]] bool continues(const Run& run) const;
  void begin(Run& run, const Session& session);
  void use_scene(Run& run, const std::shared_ptr<const Scene>& scene) const;
  bool step(Run& run, FrameSlices::Clock::time_point until);
  void seek(Run& run, const Session& session, std::int64_t frame,
            FrameSlices::Clock::time_point until);
  static void watch(Run& run, const Session& session);
  void note_hand(const Session& session);
  [[nodiscard]] const std::optional<Grab>& hand_at(std::int64_t frame) const;
  [[nodiscard]] std::vector<const SceneEdit*> edits_up_to(const Scene& scene) const;

  std::vector<Run> runs_;
  std::vector<SceneEdit> edits_;        // since the comparison began, also in discarded frames
  std::vector<Hold> hands_;             // by frame
  std::shared_ptr<const Scene> scene_;  // at the start of the comparison
  double start_ = 0.0;                  // start of the comparison [s]
  std::int64_t frame_ = 0;              // the session's frame at the last call
  Settings settings_;                   // the session's at start() or follow()
};

}  // namespace substep
