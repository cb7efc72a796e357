#include "app/shell/tour.hpp"

#include <cmath>
#include <utility>

#include "app/app.hpp"
#include "app/text/tour.hpp"
#include "core/model/number_text.hpp"

namespace substep {

Tour::Arrangement Tour::arrangement_of(Desk& desk) {
  Arrangement a{desk.tab, desk.level, desk.left.open, desk.split, desk.time.span, {}};
  for (std::size_t i = 0; i < a.shown.size(); ++i) a.shown[i] = desk.plots[i].shown;
  return a;
}

void Tour::arrange(Desk& desk, const Arrangement& a) {
  desk.tab = a.tab;
  desk.level = a.level;
  desk.left.open = a.left_open;
  desk.split = a.split;
  desk.time.span = a.span;
  for (std::size_t i = 0; i < a.shown.size(); ++i) desk.plots[i].shown = a.shown[i];
}

std::string Tour::go(App& app, std::string_view value) {
  const auto steps = tour_steps();
  const auto number = parse_number(value);
  const auto count = static_cast<double>(steps.size());
  const bool whole = number && *number == std::round(*number);
  if (value != "off" && (!whole || *number < 1.0 || *number > count)) {
    return must_be("off or a whole number from 1 to " + std::to_string(steps.size()), value);
  }
  app.desk.tour_hint = false;
  if (value == "off") {
    leave(app);
    return "";
  }
  app.introduction.leave(app);
  if (!before_) before_ = {app.run_start(), app.compare.overrides(), arrangement_of(app.desk)};
  app.desk.tour = static_cast<int>(*number) - 1;
  const TourStep& step = steps[static_cast<std::size_t>(app.desk.tour)];
  loop_.end(app);
  arrange(app.desk, before_->arrangement);
  app.desk.split = false;
  app.desk.time.span = step.loop.end;
  // The page's text replaces the controls.
  if (app.desk.tour_in_page) app.desk.left.open = false;
  opening_ = true;
  app.open_link(step.link);
  opening_ = false;
  app.reset();
  loop_.begin(app, step.loop);
  app.session.play();
  return "";
}

void Tour::follow(App& app) { loop_.follow(app, !app.desk.reduced_motion); }

bool Tour::runs(const App& app) const {
  if (!before_ || app.desk.tour < 0) return false;
  const TourStep& step = tour_steps()[static_cast<std::size_t>(app.desk.tour)];
  return app.session.scene().name == scene_of(step);
}

void Tour::close(App& app) {
  if (!before_ || opening_) return;
  app.desk.tour = -1;
  loop_.end(app);
  arrange(app.desk, std::exchange(before_, {})->arrangement);
}

void Tour::leave(App& app) {
  if (!before_) return;
  const Before before = *before_;
  close(app);
  app.run(before.run);
  if (!before.compared.empty()) app.compare.start(app.session, before.compared);
}

}  // namespace substep
