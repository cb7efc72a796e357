#pragma once
// What a person changes about the window, and not about the run.

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "app/render/scene_view.hpp"
#include "app/ui/plot.hpp"

namespace substep {

/// Which of the phone's panels is open; beside the picture, the controls always are.
enum class Tab : unsigned char { kControls, kPlots, kWhy, kCompare, kAccuracy };

/// How much of the laboratory is shown.
enum class DeskLevel : unsigned char {
  kExplore,  // scene, method, load and comparison, with the plots of N and energy
  kLab       // everything
};

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

/// Everything that a person changes about the window and not about the run.
struct Desk {
  Desk();
  [[nodiscard]] ui::PlotState& plot(Plot p) { return plots[static_cast<std::size_t>(p)]; }

  DeskLevel level = DeskLevel::kLab;  // a first visit begins in kExplore, see recall_arrangement()
  bool dark = true;
  bool panels = true;  // off: nothing but the picture
  bool help = false;
  bool more = false;             // the finer points of the method are unfolded
  bool open_share_menu = false;  // at the next frame
  std::string follow;            // a link to be followed after this frame, or ""
  std::optional<Capture> capture;
  bool recording = false;  // a video, see Host::record
  bool reduced_motion = false;
  Tab tab = Tab::kControls;
  PanelSide left;
  PanelSide right;
  double scale = 1.0;         // of everything but the picture, 0.8 to 1.5
  int tour = -1;              // step of the guided tour, or -1
  float tour_height = 0.0F;   // of its card, which the picture makes room for
  bool tour_in_page = false;  // the page shows its text, beside the canvas
  bool tour_hint = false;     // the tour was neither taken nor dismissed yet
  ViewOptions view;
  int selected = -1;       // body, or -1
  bool card_left = false;  // the side of the view that its card is on
  ui::TimeAxis time;
  std::string unfolded_scene;  // whose variants the list of scenes shows
  std::array<ui::PlotState, static_cast<std::size_t>(Plot::kCount)> plots;
  ViewRect plots_area;          // where the plots were drawn last
  bool accuracy_large = false;  // its picture lies over the view
  bool split = false;           // compared runs are drawn side by side, not as ghosts
  int compare_open = -1;        // of which of the compared the settings are shown
  int dismissed_failure = 0;    // of which run the failure was put aside
  int failure_run = 0;          // of which run the failure is shown,
  int failure_place = -1;       // and at which of the places for its card
  int pictures_in_frame = 0;    // that were drawn while one frame was computed
};

}  // namespace substep
