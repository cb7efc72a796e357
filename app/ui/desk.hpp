#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/scene_text.hpp"
#include "app/render/scene_view.hpp"
#include "app/ui/plot.hpp"
#include "app/ui/text_field.hpp"
#include "app/ui/thumbnails.hpp"

namespace substep {

/// The open panel: of all on a phone, else of the right ones, with the controls on the left.
/// The editors of the scene, as text and by hand, have no tab: they take the place of all.
enum class Tab : unsigned char { kControls, kPlots, kWhy, kCompare, kAccuracy, kText, kModel };

/// Amount of controls shown.
enum class DeskLevel : unsigned char {
  kExplore,  // scene, method, load and comparison, with the plots of N and energy
  kLab       // everything
};

enum class Plot : unsigned char { kSubsteps, kEnergy, kDrift, kError, kTime, kCount };

/// State of the panel "My model".
struct ModelDesk {
  int joint = -1;              // selected, or -1
  std::size_t joint_type = 0;  // of new joints, index into kTypes<Joint>
  bool connecting = false;     // the body that is chosen next is joined to the selected one
  std::string typing;          // the field that has the keyboard, or ""
  std::string typed;           // its text
  std::string refused;         // the field whose text was refused, or ""
  std::string refused_text;    // this text
  std::string message;         // why
};

/// A side panel.
struct PanelSide {
  float width = 0.0F;  // as dragged; 0: automatic
  bool open = true;
};

/// A screenshot of a part of the window, taken after this frame is drawn.
struct Capture {
  std::string name;  // file name
  ViewRect area;
};

/// A part of the contents of a window of Dear ImGui.
struct WindowPart : ViewRect {
  unsigned window = 0;  // Dear ImGui's id
};

/// A figure for a paper, to be saved as SVG after this frame: drawn by itself on white, without
/// controls.
struct Figure {
  std::string name;           // file name
  double millimetres = 84.0;  // width: of one column, or of the text of a page
  /// Draws it at the cursor over the width of the window.
  std::function<void(const ui::Look& look)> draw;
};
/// The widths offered for figures [mm].
inline constexpr std::array<double, 2> kFigureWidths{84.0, 174.0};

/// N as it was last shown, with its unit: the picture and the panels show the same.
struct ShownN {
  std::string n;
  std::string unit;
};

/// State of the window that does not affect the run.
struct Desk {
  Desk() {
    plot(Plot::kError).logarithmic = true;
    plot(Plot::kTime).shown = false;
  }
  [[nodiscard]] ui::PlotState& plot(Plot p) { return plots[static_cast<std::size_t>(p)]; }

  DeskLevel level = DeskLevel::kLab;  // a first visit begins in kExplore, see recall_arrangement()
  bool dark = true;
  bool panels = true;  // false: only the picture
  bool cards = true;   // false: neither the card of a failure nor the tour is offered
  bool whole = true;   // the panels are drawn in this frame, see DrawOptions
  ShownN shown_n;
  std::vector<int> shown_ns;  // N of this run and of those compared with it, as last shown
  bool help = false;
  bool more = false;             // advanced method settings are unfolded
  bool open_share_menu = false;  // in the next frame
  std::string follow;            // link to open after this frame, or ""
  std::optional<Capture> capture;
  std::optional<Figure> figure;
  bool recording = false;  // a video, see Host::record
  bool reduced_motion = false;
  Tab tab = Tab::kControls;
  Tab tab_before_text = Tab::kControls;  // to return to
  PanelSide left;
  PanelSide right;
  float text_width = 0.0F;  // of the scene's text, as PanelSide::width
  ui::TextField scene_text{SceneText::kMost};
  int scene_text_version = -1;  // SceneEditor::version() that it shows
  double scale = 1.0;           // of the interface without the picture, 0.8 to 1.5
  int tour = -1;                // step of the guided tour, or -1
  float tour_height = 0.0F;     // of its card; the picture leaves room for it
  bool tour_in_page = false;    // the page shows its text beside the canvas
  bool tour_hint = false;       // the tour was neither taken nor dismissed
  ModelDesk model;
  ViewOptions view;
  int selected = -1;                // body, or -1
  std::vector<std::string> ringed;  // joints, by their names
  bool card_left = false;           // the selection card is on the left of the view
  ui::TimeAxis time;
  std::string unfolded_scene;  // scene whose variants are unfolded in the list
  ui::Thumbnails thumbnails;   // in that list
  std::array<ui::PlotState, static_cast<std::size_t>(Plot::kCount)> plots;
  ViewRect plots_area;          // last position of the plots
  bool accuracy_large = false;  // the accuracy picture is shown over the view
  bool split = false;           // compared runs are drawn side by side, not as ghosts
  int compare_open = -1;        // index of the compared run whose settings are shown
  int dismissed_failure = 0;    // run whose failure card was dismissed
  int failure_run = 0;          // run whose failure card is shown
  int failure_place = -1;       // and its place, see card_beside()
  int pictures_in_frame = 0;    // pictures drawn while the current frame was computed
};

}  // namespace substep
