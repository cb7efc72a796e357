#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/lab/stiffness.hpp"
#include "app/text/export.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/plot.hpp"
#include "app/ui/plot_curves.hpp"
#include "app/ui/plot_labels.hpp"
#include "app/ui/plots.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

using ui::TimeAxis;

ui::Column sample(float x, float y) { return {x, y, y, y, false, false}; }

/// Of the line through the columns at x.
float between(const std::vector<ui::Column>& columns, float x) {
  std::size_t i = 1;
  while (i + 1 < columns.size() && columns[i].x < x) ++i;
  const ui::Column& a = columns[i - 1];
  const ui::Column& b = columns[i];
  return a.last + (x - a.x) / (b.x - a.x) * (b.last - a.last);
}

TEST(Thinned, CurveLooksTheSame) {
  std::vector<ui::Column> wave;
  for (int i = 0; i < 600; ++i) {
    const float x = 0.4F * static_cast<float>(i);
    wave.push_back(sample(x, 30.0F * std::sin(0.05F * x) + (i == 311 ? 5.0F : 0.0F)));
  }
  const auto kept = ui::thinned(wave, false, 0.1F);
  EXPECT_LT(kept.size(), wave.size() / 5);
  EXPECT_EQ(kept.front().x, wave.front().x);
  EXPECT_EQ(kept.back().x, wave.back().x);
  for (const ui::Column& c : wave) ASSERT_NEAR(between(kept, c.x), c.last, 0.1001F) << c.x;
}

TEST(Thinned, GapsAndStepsAreKept) {
  std::vector<ui::Column> line;
  for (int i = 0; i < 100; ++i) line.push_back(sample(static_cast<float>(i), 7.0F));
  line[40].gap = true;
  const auto kept = ui::thinned(line, false, 0.1F);
  ASSERT_EQ(kept.size(), 4U);
  EXPECT_EQ(kept[1].x, 39.0F);
  EXPECT_TRUE(kept[2].gap);

  for (std::size_t i = 60; i < 80; ++i) line[i].last = 9.0F;
  const auto steps = ui::thinned(line, true, 0.1F);
  ASSERT_EQ(steps.size(), 4U);  // the start, after the gap, up, down
  EXPECT_EQ(steps[2].x, 60.0F);
  EXPECT_EQ(steps[3].x, 80.0F);
}

TEST(Names, AreSeparatedByTheSmallestMoves) {
  const auto places = ui::apart({50.0F, 10.0F, 52.0F, 99.0F}, 12.0F, 0.0F, 100.0F);
  ASSERT_EQ(places.size(), 4U);
  for (const auto& place : places) EXPECT_TRUE(place.shown);
  EXPECT_EQ(places[1].y, 10.0F) << "far from the others it stays at its curve";
  EXPECT_EQ(places[0].y, 50.0F);
  EXPECT_EQ(places[2].y, 62.0F) << "a line below the one that it would cover";
  EXPECT_EQ(places[3].y, 94.0F) << "it lies within the plot";
}

TEST(Names, TheLastOnesAreHiddenWithoutRoom) {
  const auto places = ui::apart({5.0F, 5.0F, 5.0F}, 12.0F, 0.0F, 30.0F);
  EXPECT_TRUE(places[0].shown);
  EXPECT_TRUE(places[1].shown);
  EXPECT_FALSE(places[2].shown);
  EXPECT_GE(std::abs(places[0].y - places[1].y), 12.0F);
}

TEST(NAtLimit, IsGivenOnlyWhereNVaries) {
  Headless h;
  h.app->run(shipped("swinging_box"));
  for (int i = 0; i < 120; ++i) h.app->session.step();  // past the lowest point
  const History& history = h.app->session.history();
  Settings settings = h.app->session.settings();
  EXPECT_EQ(ui::n_at_limit(history, settings), 7) << "what const needs, see the README";
  for (const Mode mode : {Mode::kNone, Mode::kConst, Mode::kDamping, Mode::kCapped,
                          Mode::kStiffness, Mode::kInertia, Mode::kBlend}) {
    settings.mode = mode;
    EXPECT_FALSE(ui::n_at_limit(history, settings)) << static_cast<int>(mode);
  }
  settings.mode = Mode::kAdaptive;
  settings.solver = SolverKind::kPgs;
  EXPECT_FALSE(ui::n_at_limit(history, settings)) << "iterative solvers need more";
}

TEST(NAtLimit, IsNotGivenWhereOneStepWouldDo) {
  Headless h;
  h.app->run(shipped("free_fall"));
  for (int i = 0; i < 30; ++i) h.app->session.step();
  Settings settings = h.app->session.settings();
  settings.mode = Mode::kAdaptive;
  EXPECT_FALSE(ui::n_at_limit(h.app->session.history(), settings));
}

TEST(TimeAxis, TheCursorIsThePointerOrElseThePastThatIsShown) {
  TimeAxis axis;
  EXPECT_FALSE(axis.cursor());
  axis.past = 2.0;
  EXPECT_EQ(axis.cursor(), 2.0);
  axis.hover = 5.0;
  EXPECT_EQ(axis.cursor(), 5.0);
}

TEST(Plots, ValuesAreThoseOfTheMomentThatTheWindowShows) {
  Headless h;
  for (int i = 0; i < 60; ++i) h.app->session.step();
  h.frames(1);
  const auto plotted = [&] {
    return ui::shown_value(h.app->session.history(), Channel::kSubsteps, h.app->desk.time);
  };
  const int newest = h.app->session.report().n_substeps;
  EXPECT_EQ(plotted(), newest);
  h.app->session.go_to(5);
  h.frames(1);
  EXPECT_EQ(plotted(), h.app->session.report().n_substeps);
  EXPECT_NE(plotted(), newest);
  h.app->session.go_to(0);  // nothing has been taken yet
  h.frames(1);
  EXPECT_TRUE(std::isnan(plotted()));
  h.app->session.go_to(h.app->session.timeline().size() - 1);
  h.frames(1);
  EXPECT_EQ(plotted(), newest);
}

TEST(TimeAxis, FollowsTheRunAndFillsFromTheLeft) {
  TimeAxis axis;
  EXPECT_EQ(axis.window(3.0), std::make_pair(0.0, 10.0));
  EXPECT_EQ(axis.window(25.0), std::make_pair(15.0, 25.0));
}

TEST(TimeAxis, ZoomKeepsTheTimeUnderThePointer) {
  TimeAxis axis;
  axis.show(20.0, 30.0);
  EXPECT_FALSE(axis.follow);
  const double share = (23.0 - axis.window(60.0).first) / axis.span;
  axis.zoom(0.5, 23.0, 60.0);
  const auto [t0, t1] = axis.window(60.0);
  EXPECT_NEAR(t1 - t0, 5.0, 1e-12);
  EXPECT_NEAR((23.0 - t0) / axis.span, share, 1e-12);
}

TEST(TimeAxis, PanningToTheNewestFollowsAgain) {
  TimeAxis axis;
  axis.pan(-4.0, 60.0);
  EXPECT_FALSE(axis.follow);
  EXPECT_NEAR(axis.window(61.0).second, 56.0, 1e-12);  // it stays fixed while the run continues
  axis.pan(10.0, 61.0);
  EXPECT_TRUE(axis.follow);
}

TEST(TimeAxis, NeverShowsLessThanATenthOrMoreThanTenMinutes) {
  TimeAxis axis;
  for (int i = 0; i < 200; ++i) axis.zoom(0.5, 5.0, 60.0);
  EXPECT_EQ(axis.span, TimeAxis::kShortest);
  for (int i = 0; i < 200; ++i) axis.zoom(2.0, 5.0, 60.0);
  EXPECT_EQ(axis.span, TimeAxis::kLongest);
  axis.show(7.0, 7.0);
  EXPECT_GE(axis.span, TimeAxis::kShortest);
}

// Where the curves of the first plot lie in the right panel.
ViewRect plots_of(const Headless& h) { return h.app->desk.plots_area; }

TEST(Plots, ADragShowsItsRangeAndADoubleClickFollowsAgain) {
  Headless h;
  h.app->session.play();
  h.frames(300);
  h.app->session.pause();
  h.frames(2);
  const ViewRect area = plots_of(h);
  const float y = area.y + 60.0F;
  const float middle = area.x + 0.5F * area.width;
  ImGuiIO& io = ImGui::GetIO();
  io.AddMousePosEvent(middle - 20.0F, y);
  h.frames(1);
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  io.AddMousePosEvent(middle + 40.0F, y);
  h.frames(2);
  EXPECT_TRUE(h.app->desk.time.drag_from.has_value());
  io.AddMouseButtonEvent(0, false);
  h.frames(2);
  EXPECT_FALSE(h.app->desk.time.follow);
  EXPECT_GT(h.app->desk.time.span, 1.0);
  EXPECT_LT(h.app->desk.time.span, 5.0);
  EXPECT_TRUE(h.app->desk.time.hover.has_value());
  h.frames(60);  // so that the previous click does not count
  for (int i = 0; i < 2; ++i) {
    io.AddMouseButtonEvent(0, true);
    h.frames(1);
    io.AddMouseButtonEvent(0, false);
    h.frames(1);
  }
  EXPECT_TRUE(h.app->desk.time.follow);
}

TEST(Plots, WheelZoomsAllOfThem) {
  Headless h;
  h.frames(2);
  const double before = h.app->desk.time.span;
  const ViewRect area = plots_of(h);
  ImGui::GetIO().AddMousePosEvent(area.x + 0.5F * area.width, area.y + 60.0F);
  h.frames(1);
  ImGui::GetIO().AddMouseWheelEvent(0.0F, 2.0F);
  h.frames(2);
  EXPECT_LT(h.app->desk.time.span, before);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Export, TableHoldsTheChannelsOfTheShownPlots) {
  Headless h;
  for (int i = 0; i < 30; ++i) h.app->session.step();
  std::string name;
  std::string csv;
  h.app->host.save_file = [&](const std::string& n, const std::string& bytes) {
    name = n;
    csv = bytes;
  };
  ui::save_table(*h.app, h.app->desk);
  EXPECT_EQ(name, "swinging_box-adaptive.csv");
  const auto lines = lines_of(csv);
  ASSERT_EQ(lines.size(), 31U);
  EXPECT_EQ(
      lines[0],
      "frame,time,substeps,substeps_mean,substeps_least,kinetic,potential,energy,energy_put_in,"
      "energy_drift,"
      "constraint_error,joint_gap");
  EXPECT_TRUE(lines[30].starts_with("30,0.5,")) << lines[30];
  // The energy is the total, not its change.
  const FrameReport& r = h.app->session.report();
  std::istringstream last(lines[30]);
  std::vector<double> values;
  for (std::string field; std::getline(last, field, ',');) values.push_back(std::stod(field));
  EXPECT_NEAR(values[5], r.kinetic, 1e-6 * r.kinetic);
  EXPECT_NEAR(values[7], r.energy, 1e-4 * r.kinetic);

  h.app->desk.plot(Plot::kEnergy).shown = false;
  ui::save_table(*h.app, h.app->desk);
  EXPECT_EQ(lines_of(csv)[0].find("kinetic"), std::string::npos);
}

TEST(Export, PictureHasThePixelsOfItsArea) {
  Headless h(1280, 720, 2.0F);
  std::string png;
  h.app->host.save_file = [&](const std::string&, const std::string& bytes) { png = bytes; };
  h.app->desk.capture = {"view.png", {100.0F, 50.0F, 300.0F, 200.0F}};
  h.frames(1);
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(png[i]); };
  EXPECT_EQ(256 * at(18) + at(19), 600);
  EXPECT_EQ(256 * at(22) + at(23), 400);
  EXPECT_FALSE(h.app->desk.capture.has_value());
}

TEST(Why, TheFirstBodyOfTheListSetsN) {
  Headless h;
  h.app->desk.tab = Tab::kWhy;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    h.app->session.play();
    for (const char* mode : {"none", "const", "damping", "adaptive", "capped"}) {
      ASSERT_EQ(h.app->set("mode", mode), "");
      h.frames(6);
      const auto list = stiffness_by_body(*scene, h.app->session.state());
      const StiffnessLeader& leader = h.app->session.report().leader;
      if (leader.body < 0) {
        EXPECT_TRUE(list.empty() || list.front().r == 0.0) << scene->name << ", " << mode;
        continue;
      }
      ASSERT_FALSE(list.empty()) << scene->name << ", " << mode;
      EXPECT_EQ(list.front().body, leader.body) << scene->name << ", " << mode;
      EXPECT_EQ(list.front().dof, leader.dof);
      EXPECT_EQ(list.front().r, leader.r);
      EXPECT_TRUE(std::is_sorted(list.begin(), list.end(),
                                 [](const auto& a, const auto& b) { return a.r > b.r; }));
    }
  }
}

}  // namespace
}  // namespace substep
