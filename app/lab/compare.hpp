#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/session.hpp"

namespace substep {

/// One setting that differs from those of the run that it is compared with, as links spell it.
struct Override {
  std::string key;
  std::string value;
  friend bool operator==(const Override&, const Override&) = default;
};
using Overrides = std::vector<Override>;

/// What a run has cost since the comparison began.
struct Cost {
  std::int64_t frames = 0;
  std::int64_t substeps = 0;
  double seconds = 0.0;  // of computing
};

/// When a run left the one that it is compared with: a body was farther away than the threshold.
struct Divergence {
  double time = 0.0;  // [s]
  int body = 0;
  double distance = 0.0;  // [m]
};

/// Other methods on the same scene and the same clock: each of a session's frames is taken by all
/// of them, from the same state on. What a person does to the session is done to all of them: a
/// hand pulls each one's own body to the same place, a ball is thrown into each.
class Compare {
 public:
  static constexpr std::size_t kMost = 3;     // beside the session itself
  static constexpr double kThreshold = 0.01;  // [m]

  /// One of the other methods.
  struct Run {
    Overrides overrides;
    std::shared_ptr<const Scene> scene;  // the session's, or one that it came from
    std::unique_ptr<Simulator> simulator;
    std::optional<Verdict> verdict;
    FrameReport report;
    History history;
    Poses poses;  // to draw, in between two frames as those of the session are
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
    };
    std::vector<Checkpoint> checkpoints;  // oldest first
  };

  [[nodiscard]] bool open() const { return !runs_.empty(); }
  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  /// The methods of all runs.
  [[nodiscard]] std::vector<Overrides> overrides() const;
  /// Of the session, since the comparison began.
  [[nodiscard]] Cost cost(const Session& session) const;

  /// Runs these beside the session, from its present state on. None closes the comparison.
  void start(const Session& session, std::vector<Overrides> runs);
  void close() { runs_.clear(); }
  /// From the session's present state on, with the same methods.
  void restart(const Session& session);
  /// Adds, changes or removes one, and restarts all of them.
  void add(const Session& session, Overrides one);
  void remove(const Session& session, std::size_t index);
  /// Changes the method of one that runs, live.
  void change(const Session& session, std::size_t index, const Settings& settings);

  /// The session has taken a frame: so do the others, as far as a slice of time allows; follow()
  /// goes on with it. @return whether they are all there
  bool take_frame(const Session& session);
  /// Whether one of them has not reached the session's frame yet.
  [[nodiscard]] bool behind(const Session& session) const;
  /// The session's scene was edited: so are the others'.
  void edit(const Session& session, const SceneEdit& edit);
  /// Once a picture: follows the session where it was set back or changed, as far as a slice of
  /// time allows, and sets the poses.
  void follow(const Session& session);

  /// The settings of one: those of the session but for its overrides.
  [[nodiscard]] static Settings settings_of(const Overrides& overrides, const Settings& session);

 private:
  /// A hand on a body from a frame on, or none.
  struct Hold {
    std::int64_t frame = 0;
    std::optional<Grab> grab;
  };

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
  std::vector<SceneEdit> edits_;  // since the comparison began, those of forgotten futures too
  std::vector<Hold> hands_;       // by frame
  std::shared_ptr<const Scene> scene_;  // that the comparison began with
  double start_ = 0.0;                  // when it began [s]
  std::int64_t frame_ = 0;              // of the session when it was looked at last
  Settings settings_;                   // of the session then
};

/// "mode:none;mode:damping,alpha:0.2": the runs of a comparison as links spell them.
std::string overrides_text(const std::vector<Overrides>& runs);
/// Reads such text. @param problem what is wrong with it, or ""
std::vector<Overrides> parse_overrides(std::string_view text, std::string& problem);
/// What the overrides are, for people: "no sub-steps, PGS". "the same" where there are none.
std::string overrides_title(const Overrides& overrides);

}  // namespace substep
