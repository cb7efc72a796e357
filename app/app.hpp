#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/accuracy.hpp"
#include "app/lab/compare.hpp"
#include "app/lab/exam_ghost.hpp"
#include "app/lab/library.hpp"
#include "app/lab/own_scenes.hpp"
#include "app/lab/session.hpp"
#include "app/render/quality.hpp"
#include "app/render/renderer.hpp"
#include "app/render/scene_view.hpp"
#include "app/shell/file_browser.hpp"
#include "app/ui/look.hpp"
#include "app/ui/plot.hpp"
#include "core/io/scene_reader.hpp"

namespace substep {

/// What a shell can do for the application. Each may be empty.
struct Host {
  std::function<void(const std::string& fragment)> link_changed;  // keeps the address up to date
  std::function<void()> copy_link;  // puts the address that holds the experiment on the clipboard
  std::function<void()> open_link;  // follows the link on the clipboard
  std::function<void()> open_file;  // lets the person choose a scene file, and opens it
  std::function<void(bool on)> record;  // begins and ends a video of the window
  /// Hands a file to the person: into the working folder natively, a download in the page.
  std::function<void(const std::string& name, const std::string& bytes)> save_file;
  /// Keeps how the window is arranged from one visit to the next; "" where nothing was kept.
  std::function<void(const std::string& key, const std::string& value)> remember;
  std::function<std::string(const std::string& key)> recall;
};

inline constexpr const char* kSceneKept = "The scene that runs was kept.";

/// What went wrong with outside data: shown in a panel until it is closed.
struct Trouble {
  std::string title;  // "my_scene.json was not loaded"
  std::vector<Problem> problems;
  std::string aftermath = kSceneKept;  // what was done all the same; may be empty
};

/// Which of the phone's panels is open; beside the picture, the controls always are.
enum class Tab : unsigned char { kControls, kPlots, kWhy, kCompare, kAccuracy };

enum class Plot : unsigned char { kSubsteps, kEnergy, kDrift, kError, kTime, kCount };

/// A panel at a side of the picture.
struct PanelSide {
  float width = 0.0F;  // as it was dragged; 0: what suits the window
  bool open = true;
};

/// A picture of a part of the window, taken when this frame has been drawn.
struct Capture {
  std::string name;  // of the file
  ViewRect area;
};

/// A sentence that is shown for a moment.
struct Notice {
  std::string text;
  double left = 0.0;  // [s]
};

/// What the pointer does in the picture while its button is down.
struct Hand {
  std::size_t pane = 0;        // that it went down in
  int body = -1;               // that it went down on, or -1
  Vec3 anchor = Vec3::Zero();  // where on it, body frame [m]
  Vec3 point = Vec3::Zero();   // the same in the world; it moves in the plane of view there [m]
  bool moved = false;          // farther than a click
  bool holding = false;        // the body follows
};

/// Everything that a person changes about the window and not about the run.
struct Desk {
  Desk();
  [[nodiscard]] ui::PlotState& plot(Plot p) { return plots[static_cast<std::size_t>(p)]; }

  bool dark = true;
  bool panels = true;  // off: nothing but the picture
  bool help = false;
  bool more = false;             // the finer points of the method are unfolded
  bool open_share_menu = false;  // at the next frame
  bool reduced_motion = false;
  Tab tab = Tab::kControls;
  PanelSide left;
  PanelSide right;
  double scale = 1.0;        // of everything but the picture, 0.8 to 1.5
  int tour = -1;             // step of the guided tour, or -1
  float tour_height = 0.0F;  // of its card, which the picture makes room for
  bool tour_hint = false;    // nobody has taken it or put it aside yet
  ViewOptions view;
  int selected = -1;       // body, or -1
  bool card_left = false;  // the side of the view that its card is on
  ui::TimeAxis time;
  std::array<ui::PlotState, static_cast<std::size_t>(Plot::kCount)> plots;
  ViewRect plots_area;          // where the plots were drawn last
  bool accuracy_large = false;  // its picture lies over the view
  bool split = false;           // what is compared is seen side by side, not as ghosts
  int compare_open = -1;        // of which of the compared the settings are shown
  int dismissed_failure = 0;    // of which run the failure was put aside
};

/// The application: one scene running, the view of it, and the panels around it. The same in the
/// native window, in the page and in tests; the shell owns the window, its events and the clock.
struct App {
  /// @param library not empty; its first scene runs
  App(Library library, std::unique_ptr<Renderer> renderer);
  App(const App&) = delete;  // the session calls back
  App& operator=(const App&) = delete;

  /// Runs a shipped scene. @return false where there is none of that name
  bool open(std::string_view name);
  /// Runs a scene given as text. Where it has problems they are shown and the old one goes on.
  /// @param from what people call it: a file's name
  bool open_text(std::string_view json, const std::string& from);
  /// The same for the text of a file, or for what was wrong with reading it.
  bool open_result(SceneResult result, const std::string& from);
  /// Adds a scene to the person's own, here and at the next visit. @return as it is in the library
  std::shared_ptr<const Scene> add_own(const Scene& scene);
  /// Brings back the person's own scenes of earlier visits. Called once, when the host is there.
  void recall_scenes();
  /// Hands the run as it is now to the person, as a scene file.
  void save_scene();
  void run(std::shared_ptr<const Scene> scene);
  /// Changes a part of the experiment: "scene", "solver", "alpha", ... as links spell them.
  /// @return what is wrong with it, or ""
  std::string set(std::string_view key, std::string_view value);
  /// The experiment that a link describes; what cannot be read is shown and the rest holds.
  void open_link(std::string_view fragment);
  [[nodiscard]] std::string link() const;
  /// The scene that a link starts from: the loaded one, or, where it was edited since (a ball
  /// thrown, an effect switched off), the scene as it stood at the last edit.
  [[nodiscard]] const Scene& link_scene() const;
  /// What to type for the same run on the command line.
  [[nodiscard]] std::string command() const;
  void reset();
  /// Whether something goes on by itself: a run that plays, a sweep, a search.
  [[nodiscard]] bool busy() const { return session.playing() || accuracy.busy(); }
  /// Runs the scene from another of its starts, with the settings as they are.
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
  /// New settings for the run, live.
  void change(const Settings& settings);

  /// Says something in passing.
  void tell(std::string text);

  Library library;
  Session session;
  Compare compare;
  ExamGhost exam;  // of scenes with a known answer
  Accuracy accuracy;
  SceneView view;
  Desk desk;
  Host host;
  std::unique_ptr<Renderer> renderer;
  Trouble trouble;  // none where the title is empty
  Notice notice;
  std::optional<Capture> capture;
  OwnScenes own;
  FileBrowser browser;
  bool recording = false;  // a video, see Host::record
  // The scene as it was loaded, and which of its starts runs: Experiment's load and seed.
  std::shared_ptr<const Scene> plain_scene;
  double load = 1.0;  // [-]
  int seed = 0;
  double pause_at = 0.0;  // an experiment's end, 0 where there is none [s]
  int run_count = 0;      // resets and loads

  // Kept by frame().
  /// Colour of a run that is compared, in plots and in the picture.
  [[nodiscard]] ImU32 compare_color(std::size_t run) const;

  ui::Look look;
  float pixel_ratio = 0.0F;        // that the fonts were made for
  double frame_time = 1.0 / 60.0;  // smoothed [s]
  double own_time = 0.0;           // that the last frame took to simulate [s]
  QualityGovernor quality;
  ViewRect view_rect;
  /// Where runs are seen: this one in the first or only pane, those compared in the others.
  std::vector<ViewRect> panes{1};
  std::vector<Picture> pictures{1};  // of the panes
  [[nodiscard]] const Scene& scene_in(std::size_t pane) const;
  [[nodiscard]] const Poses& poses_in(std::size_t pane) const;
  Hand hand;
  bool pointer_on_picture = false;
  std::string last_link;
  std::string last_arrangement;
  unsigned last_event = 0;  // of Dear ImGui, that was brought to the scale
};

/// One frame on the screen: lets the time pass, builds the panels, draws. The shell has told Dear
/// ImGui the display's size, its pixel ratio and the events.
/// @param wall_dt time since the last call [s]
void frame(App& app, double wall_dt);

}  // namespace substep
