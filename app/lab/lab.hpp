#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/lab/accuracy.hpp"
#include "app/lab/compare.hpp"
#include "app/lab/exam_ghost.hpp"
#include "app/lab/heavy_start.hpp"
#include "app/lab/host.hpp"
#include "app/lab/library.hpp"
#include "app/lab/own_scenes.hpp"
#include "app/lab/session.hpp"
#include "core/io/scene_reader.hpp"

namespace substep {

/// What runs and what is remembered of it, without a window: the scenes that there are, the run,
/// what runs beside it, and what was measured.
struct Lab {
  /// @param library not empty; its first scene runs
  explicit Lab(Library library);
  Lab(const Lab&) = delete;  // the session calls back
  Lab& operator=(const Lab&) = delete;

  /// Runs a shipped scene. @return false where there is none of that name
  bool open(std::string_view name);
  /// Runs a scene given as text. If it has problems they are shown and the old run continues.
  /// @param from what people call it: a file's name
  bool open_text(std::string_view json, const std::string& from);
  /// The same for the text of a file, or for what was wrong with reading it.
  bool open_result(SceneResult result, const std::string& from);
  /// open_result() up to start_opened(): the run is there and paused. A page answers in between.
  bool open_paused(SceneResult result, const std::string& from);
  /// Plays the run that was opened. If its frames take long it stays paused, and a card says why.
  void start_opened();
  /// Adds a scene to the person's own, here and at the next visit. @return as it is in the library
  std::shared_ptr<const Scene> add_own(const Scene& scene);
  /// Brings back the person's own scenes of earlier visits. Called once, when the host is there.
  void recall_scenes();
  /// Hands the run as it is now to the person, as a scene file.
  void save_scene();
  void run(std::shared_ptr<const Scene> scene);
  void reset();
  /// New settings for the run, live. Whether K is watched stays as it is.
  void change(const Settings& settings);
  /// Whether K is evaluated in every mode, for display.
  void watch_stiffness(bool on);
  /// Runs the scene from another of its starts, with the settings and the comparison as they are.
  void vary(double load, int seed);
  /// Runs a point of the accuracy picture from its start.
  void run_result(const Result& result);
  /// Makes the scene of the accuracy picture one of the person's own, which starts with what its
  /// sweep recommends, and runs it.
  void keep(const Recommended& recommended);
  /// Measures what the parts of this run's frames cost, from its start.
  void measure_costs();
  /// What was measured of this run with its present settings, or null.
  [[nodiscard]] const CostBreakdown* costs() const;
  /// How the run began, to go back to it.
  [[nodiscard]] RunStart run_start() const;
  void run(const RunStart& start);
  /// Whether the run waits for a person to start it.
  [[nodiscard]] bool held() const { return !heavy.why.empty() && heavy.run == run_count; }
  /// Whether anything runs without input: a run that plays, a sweep, a search.
  [[nodiscard]] bool busy() const {
    return session.playing() || accuracy.busy() || compare.behind(session);
  }

  /// Of the bodies that move, in the scene as it was loaded [kg]; the load is a factor on it.
  [[nodiscard]] double heaviest_mass() const;
  /// The experiment as the fragment of an address.
  [[nodiscard]] std::string link() const;
  /// The scene that a link starts from: the loaded one, with what was done to it as events; where
  /// those are too many, the scene as it stood when it was last edited.
  [[nodiscard]] const Scene& link_scene() const;
  /// What to type for the same run on the command line.
  [[nodiscard]] std::string command() const;
  /// This run, 0, or one of those that are compared with it.
  [[nodiscard]] const Scene& scene_in(std::size_t pane) const;
  [[nodiscard]] const Poses& poses_in(std::size_t pane) const;
  /// Says something in passing.
  void tell(std::string text);

  Library library;
  OwnScenes own;
  Session session;
  Compare compare;
  ExamGhost exam;  // of scenes with a known answer
  Accuracy accuracy;
  Host host;
  Trouble trouble;  // none where the title is empty
  Notice notice;
  std::optional<OpenedRun> opened;  // that start_opened() plays
  HeavyStart heavy;
  // The scene as it was loaded, and which of its starts runs: Experiment's load and seed.
  std::shared_ptr<const Scene> plain_scene;
  double load = 1.0;  // [-]
  int seed = 0;
  double pause_at = 0.0;        // an experiment's end, 0 where there is none [s]
  int run_count = 0;            // resets and loads
  bool hold_at_failure = true;  // a run that fails pauses, where nothing is compared with it
  /// Called after the run was restarted. @param loaded with another scene
  std::function<void(bool loaded)> restarted;

 private:
  /// The scene as it stood when it was last edited (a ball thrown, an effect switched off), else
  /// the loaded one.
  [[nodiscard]] const Scene& edited_scene() const;
  [[nodiscard]] std::string events_in_link() const;
};

}  // namespace substep
