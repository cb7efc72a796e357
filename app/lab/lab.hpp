#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/lab/accuracy.hpp"
#include "app/lab/compare.hpp"
#include "app/lab/exam_ghost.hpp"
#include "app/lab/failure.hpp"
#include "app/lab/find_n.hpp"
#include "app/lab/heavy_start.hpp"
#include "app/lab/host.hpp"
#include "app/lab/library.hpp"
#include "app/lab/opened_text.hpp"
#include "app/lab/own_scenes.hpp"
#include "app/lab/scene_editor.hpp"
#include "app/lab/session.hpp"
#include "core/io/scene_reader.hpp"
#include "core/lab/remedy.hpp"

namespace substep {

/// The laboratory without a window: the scene library, the run, the runs compared with it, and the
/// measurements.
struct Lab {
  /// @param library not empty; its first scene runs
  explicit Lab(Library library);
  Lab(const Lab&) = delete;  // session holds callbacks to this object
  Lab& operator=(const Lab&) = delete;

  /// Runs a shipped scene. @return false if there is none of that name
  bool open(std::string_view name);
  /// Runs a scene given as text, or as a model in a format that is imported. If it has problems
  /// they are shown and the current run continues.
  /// @param from its name in messages: a file name
  bool open_text(std::string_view text, const std::string& from);
  /// Like open_text(), for a file.
  bool open_file(const std::filesystem::path& path);
  /// Like open_text(), for a text already read.
  bool open_opened(OpenedText read, const std::string& from);
  /// Like open_text(), for a scene already read, or the problems of reading it.
  bool open_result(SceneResult result, const std::string& from);
  /// open_result() without start_opened(): the run is loaded and paused, so that a page can redraw
  /// in between.
  bool open_paused(SceneResult result, const std::string& from);
  /// Plays the opened run. If its frames are slow it stays paused, and a card gives the reason.
  void start_opened();
  /// Adds a scene to the user's own, and stores it. @return the scene in the library
  std::shared_ptr<const Scene> add_own(const Scene& scene);
  /// Removes one of the user's own scenes from the library. Call store_own() afterwards.
  void remove_own(const std::string& name);
  /// Stores the user's own scenes for later visits.
  void store_own();
  /// Restores the user's own scenes of earlier visits. Call once, after the host is set.
  void recall_scenes();
  /// Saves the run in its current state as a scene file.
  void save_scene();
  void run(std::shared_ptr<const Scene> scene);
  void reset();
  /// Changes the settings of the run live, except the evaluation of K for display.
  void change(const Settings& settings);
  /// Whether K is evaluated in every mode, for display.
  void watch_stiffness(bool on);
  /// Restarts the scene with another load and seed; keeps the settings and the comparison.
  void vary(double load, int seed);
  /// Runs a point of the accuracy picture from its start.
  void run_result(const Result& result);
  /// The scene of this run: with its load and seed, or from its last edit.
  [[nodiscard]] FindScene find_scene() const;
  /// Starts "Find N" on it, within the error that is set.
  void start_find_n();
  /// Runs a result of "Find N" from its start.
  void run_found(const Result& result);
  /// Saves the scene of the accuracy picture as one of the user's own, with the settings that its
  /// sweep recommends, and runs it.
  void keep(const Recommended& recommended);
  /// Measures the cost breakdown of this run's frames, from its start.
  void measure_costs();
  /// The breakdown of this run with its current settings, or null.
  [[nodiscard]] const CostBreakdown* costs() const;
  /// The start of the current run, to return to it.
  [[nodiscard]] RunStart run_start() const;
  void run(const RunStart& start);
  /// Whether the run waits for confirmation.
  [[nodiscard]] bool held() const { return !heavy.why.empty() && heavy.run == run_count; }
  /// Computes the run up to a time, and pauses there, unless the user plays, steps or seeks
  /// meanwhile. @param time [s]
  void seek(double time);
  /// Whether it is on its way there.
  [[nodiscard]] bool seeking() const { return seek_to_ > 0.0 && seek_run_ == run_count; }
  /// Continues. @param seconds budget in this frame
  void continue_seek(double seconds);
  /// Whether anything runs without input: playback, a sweep, a search.
  [[nodiscard]] bool busy() const {
    return session.playing() || seeking() || accuracy.busy() || find_n.busy() ||
           compare.behind(session) || trying_remedies() || editor.waiting();
  }

  /// Largest mass of a moving body in the scene as loaded [kg]; the load multiplies it.
  [[nodiscard]] double heaviest_mass() const;
  /// The experiment as a URL fragment.
  [[nodiscard]] std::string link() const;
  /// The scene that a link starts from: the loaded one, with user actions as events; if those do
  /// not fit, the scene at its last edit.
  [[nodiscard]] const Scene& link_scene() const;
  /// The command line for the same run, from the root of the sources: "./dev cli run bridge --mode
  /// const --n 12 --frames 240". Names the scene, or the saved file of one of the user's own.
  [[nodiscard]] std::string command() const;
  /// Pane 0 is this run; the others are the runs compared with it.
  [[nodiscard]] const Scene& scene_in(std::size_t pane) const;
  [[nodiscard]] const Poses& poses_in(std::size_t pane) const;
  /// Whether this run has failed in a comparison: it continues, because the others share its clock,
  /// but the frame that failed is shown.
  [[nodiscard]] bool frozen() const;
  /// What failed in a pane, while it shows the frame that failed.
  [[nodiscard]] std::optional<Failure> failure_in(std::size_t pane) const;
  /// Tries remedies for the failed run, from the start of its scene for as long as it is judged.
  /// @param seconds budget in this frame
  void try_remedies(double seconds);
  /// Trials for the failed run, or null.
  [[nodiscard]] const RemedyTrials* remedy_trials() const;
  [[nodiscard]] bool trying_remedies() const {
    const RemedyTrials* trials = remedy_trials();
    return trials != nullptr && !trials->done();
  }
  /// Shows a notice for a moment.
  void tell(std::string text);

  Library library;
  OwnScenes own;
  SceneEditor editor;
  Session session;
  Compare compare;
  ExamGhost exam;  // of scenes with a known answer
  Accuracy accuracy;
  FindN find_n;
  Host host;
  Trouble trouble;  // none if the title is empty
  Notice notice;
  std::optional<OpenedRun> opened;  // to be played by start_opened()
  HeavyStart heavy;
  // The scene as loaded, before load and seed are applied; both as in Experiment.
  std::shared_ptr<const Scene> plain_scene;
  double load = 1.0;  // [-]
  int seed = 0;
  double pause_at = 0.0;        // end of an experiment, 0 if none [s]
  int run_count = 0;            // resets and loads
  bool keeps_view = false;      // the scene that was loaded is seen from where the last one was
  bool hold_at_failure = true;  // a failed run pauses, or freezes if it is being compared
  /// Called after a restart. @param loaded whether another scene was loaded
  std::function<void(bool loaded)> restarted;

 private:
  /// This run at the frame that failed in a comparison.
  struct FailedFrame {
    std::shared_ptr<const Scene> scene;
    Poses poses;
    FrameReport report;
  };
  void note_failure();
  /// The scene at its last edit (a ball thrown, an effect switched off), or the loaded one.
  [[nodiscard]] const Scene& edited_scene() const;
  [[nodiscard]] std::string events_in_link() const;

  FailedFrame failed_frame_;  // of frozen()
  double seek_to_ = 0.0;      // [s]
  int seek_run_ = 0;          // the run_count that it belongs to
  static constexpr std::int64_t kNotBegun = -1;
  std::int64_t seek_frame_ = kNotBegun;  // that it has reached
  std::optional<RemedyTrials> trials_;
  int trials_run_ = 0;  // the run_count that they belong to
};

}  // namespace substep
