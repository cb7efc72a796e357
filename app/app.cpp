#include "app/app.hpp"

#include <utility>

namespace substep {

App::App(Library shipped, std::unique_ptr<Renderer> draws)
    : Lab(std::move(shipped)), renderer(std::move(draws)) {
  restarted = [this](bool loaded) {
    if (loaded) desk.selected = desk.model.joint = -1;
    if (loaded) desk.ringed.clear();
    if (loaded) introduction.close(*this);  // another run has replaced it
    if (loaded && !tour.runs(*this)) tour.close(*this);
    // A restarted run is shown from its start, at the chosen zoom.
    for (ui::PlotState& plot : desk.plots) plot.set = false;
    desk.time.from = 0.0;
    desk.time.follow = true;
  };
  watch_stiffness(desk.view.tint);
  // Each step down from the finest would take four frames of a fifth of a second.
  if (renderer->deferred()) quality = QualityGovernor(Quality::kSketch);
}

}  // namespace substep
