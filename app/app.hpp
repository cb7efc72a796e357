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

/// The application: the laboratory, seen through a window. The same natively, in the page and in
/// tests; the shell owns the window, its events and the clock. Panels take of it what they show.
struct App : Lab, Viewport {
  /// @param library not empty; its first scene runs
  App(Library library, std::unique_ptr<Renderer> renderer);

  /// Changes a part of the experiment: "scene", "solver", "alpha", ... as links spell them.
  /// @return what is wrong with it, or ""
  std::string set(std::string_view key, std::string_view value);
  /// The experiment that a link describes; what cannot be read is shown and the rest holds.
  /// @param scene the one that came with it, or what was wrong with that
  void open_link(std::string_view fragment, std::optional<SceneResult> scene = {});
  /// The same, up to start_opened().
  void open_link_paused(std::string_view fragment, std::optional<SceneResult> scene = {});
  /// The experiment as the fragment of an address, with the level where that is Explore.
  [[nodiscard]] std::string link() const;

  Desk desk;
  Introduction introduction;
  Tour tour;
  ui::Look look;
  std::unique_ptr<Renderer> renderer;
  FileBrowser browser;

  // Kept by frame().
  float pixel_ratio = 0.0F;        // that the fonts were made for
  double frame_time = 1.0 / 60.0;  // smoothed [s]
  double own_time = 0.0;           // that the last frame took to simulate [s]
  QualityGovernor quality;
  std::string last_link;
  std::string last_arrangement;
  unsigned last_event = 0;  // of Dear ImGui, that was brought to the scale
};

/// One frame on the screen: lets the time pass, builds the panels, draws. The shell has told Dear
/// ImGui the display's size, its pixel ratio and the events.
/// @param wall_dt time since the last call [s]
void frame(App& app, double wall_dt);

}  // namespace substep
