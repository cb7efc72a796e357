#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/lab/introduction.hpp"
#include "app/lab/lab.hpp"
#include "app/render/quality.hpp"
#include "app/render/renderer.hpp"
#include "app/shell/file_browser.hpp"
#include "app/shell/tour.hpp"
#include "app/ui/desk.hpp"
#include "app/ui/look.hpp"
#include "app/ui/viewport.hpp"

namespace substep {

/// The application: the laboratory in a window. Identical natively, in the page and in tests; the
/// shell owns the window, its events and the clock. Panels take only the parts that they show.
struct App : Lab, Viewport {
  /// @param library not empty; its first scene runs
  App(Library library, std::unique_ptr<Renderer> renderer);

  /// Changes a part of the experiment: "scene", "solver", "alpha", ... as links spell them.
  /// @return error message, or ""
  std::string set(std::string_view key, std::string_view value);
  /// Opens the experiment in a link. Unreadable parts are reported; the rest applies.
  /// @param scene the scene that came with the link, or the error from reading it
  void open_link(std::string_view fragment, std::optional<SceneResult> scene = {});
  /// Like open_link(), but stops before start_opened().
  void open_link_paused(std::string_view fragment, std::optional<SceneResult> scene = {});
  /// The experiment as a URL fragment; includes the level if it is Explore.
  [[nodiscard]] std::string link() const;

  Desk desk;
  Introduction introduction;
  Tour tour;
  ui::Look look;
  std::unique_ptr<Renderer> renderer;
  FileBrowser browser;

  // State of frame().
  float pixel_ratio = 0.0F;        // of the current fonts
  double frame_time = 1.0 / 60.0;  // smoothed [s]
  double own_time = 0.0;           // simulation time of the last frame [s]
  QualityGovernor quality;
  std::string last_link;
  std::shared_ptr<const Scene> last_linked;  // the scene of that link: another may have its name
  std::string last_arrangement;
  unsigned last_event = 0;  // last Dear ImGui event that was rescaled
};

/// One frame: advances the simulation, builds the panels, draws. The shell has already passed the
/// display size, pixel ratio and events to Dear ImGui.
/// @param wall_dt time since the last call [s]
/// @param whole see DrawOptions
void frame(App& app, double wall_dt, bool whole = true);

}  // namespace substep
