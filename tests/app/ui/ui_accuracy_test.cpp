// The panel "What does accuracy cost?": a sweep in slices, and points that run.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "app/ui/curve_style.hpp"
#include "core/model/format_text.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

TEST(Accuracy, TheSweepAdvancesWhileTheWindowResponds) {
  Headless h;
  h.app->open("pendulum");
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.frames(3);
  EXPECT_FALSE(h.app->accuracy.running()) << "nothing runs without a request";
  ASSERT_EQ(h.app->set("accuracy", "run"), "");
  EXPECT_TRUE(h.app->accuracy.running());
  double before = 0.0;
  std::size_t stages = 0;
  std::size_t results = 0;
  for (int i = 0; i < 20000 && h.app->accuracy.running(); ++i) {
    h.frames(1);
    EXPECT_GE(h.app->accuracy.progress(), before);
    before = h.app->accuracy.progress();
    stages += h.app->accuracy.results().size() > results ? 1U : 0U;
    results = h.app->accuracy.results().size();
  }
  EXPECT_EQ(h.app->accuracy.progress(), 1.0);
  EXPECT_EQ(h.app->accuracy.results().size(), h.app->accuracy.planned());
  EXPECT_GT(stages, 5U) << "results arrive in several frames";
  EXPECT_GT(h.app->accuracy.points().size(), 50U);
  std::set<std::string> series;
  for (const Result& r : h.app->accuracy.results()) {
    series.insert(series_name(r.experiment.settings));
  }
  EXPECT_GE(series.size(), 12U);
}

TEST(Accuracy, TheCheapestWithinAnErrorRunsOnAClick) {
  Headless h;
  h.app->open("pendulum");
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  ASSERT_EQ(h.app->set("accuracy", "run"), "");
  finish(h);
  Accuracy& accuracy = h.app->accuracy;
  accuracy.wanted[0] = 1e-4;
  h.frames(2);
  const std::vector<Accuracy::Point> points = accuracy.points();
  const auto best = accuracy.best(points);
  const auto paper = accuracy.best(of_paper(points, accuracy.results()));
  ASSERT_TRUE(best.has_value());
  EXPECT_LE(best->error, 1e-4);
  for (const Accuracy::Point& p : points) {
    EXPECT_TRUE(p.error > 1e-4 || best->cost <= p.cost);
  }
  EXPECT_FALSE(paper.has_value()) << "Euler is 10 mm off with the one step that it asks for";
  const Settings wanted = accuracy.results()[best->result].experiment.settings;
  h.app->desk.tab = Tab::kAccuracy;
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  h.press("Run it");
  EXPECT_EQ(h.app->session.settings().solver, wanted.solver);
  EXPECT_EQ(h.app->session.settings().n, wanted.n);
  EXPECT_TRUE(h.app->session.playing());
  accuracy.wanted[0] = 1e-12;
  h.frames(2);
  EXPECT_FALSE(accuracy.best(points).has_value());
}

TEST(Accuracy, TheMostExactWithinACostIsFoundOnAClick) {
  Headless h;
  h.app->open("pendulum");
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  ASSERT_EQ(h.app->set("accuracy", "run"), "");
  finish(h);
  Accuracy& accuracy = h.app->accuracy;
  accuracy.cost = CostAxis::kSubsteps;
  h.app->desk.tab = Tab::kAccuracy;
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  h.press("a cost");
  ASSERT_FALSE(accuracy.error_is_given);
  for (const double budget : {1.0, 4.0, 16.0}) {
    accuracy.budget[0] = budget;
    const std::vector<Accuracy::Point> points = accuracy.points();
    const auto best = accuracy.best(points);
    ASSERT_TRUE(best.has_value());
    EXPECT_LE(best->cost, budget);
    for (const Accuracy::Point& p : points) {
      EXPECT_TRUE(p.cost > budget || best->error <= p.error);
    }
  }
  const auto best = accuracy.best(accuracy.points());
  const Settings wanted = accuracy.results()[best->result].experiment.settings;
  h.frames(2);
  h.press("Run it");
  EXPECT_EQ(h.app->session.settings().solver, wanted.solver);
  EXPECT_EQ(h.app->session.settings().n, wanted.n);
  accuracy.budget[0] = 0.5;
  EXPECT_FALSE(accuracy.best(accuracy.points()).has_value());
}

// Frames wait for the 60 Hz display. A late frame must not delay the next ones.
TEST(Accuracy, TakesAShareOfSlowFramesAndLetsOthersRecover) {
  for (const bool plays : {false, true}) {
    const double least = Accuracy::slice(plays, 1.0 / 60.0);
    for (const double drawing : {0.002, 0.005, 0.008}) {
      double wall = 0.1;  // one slow frame
      double own = least;
      for (int i = 0; i < 10; ++i) {
        own = Accuracy::slice(plays, wall - own);
        wall = std::ceil((drawing + own) * 60.0) / 60.0;
      }
      EXPECT_EQ(own, least);
    }
    EXPECT_GT(Accuracy::slice(plays, 0.1), 0.015) << "a page without a graphics processor";
    EXPECT_LT(Accuracy::slice(plays, 0.1), 0.1);
    EXPECT_LT(Accuracy::slice(plays, 1e6), 0.2) << "a suspended tab";
  }
}

TEST(Accuracy, FindsThePapersAlphaForTheLimit) {
  Headless h;
  h.app->open("pendulum");
  EXPECT_NE(h.app->set("accuracy", "alpha"), "") << "there is no reference";
  h.app->set("panel", "accuracy");
  h.app->set("accuracy", "run");
  finish(h);
  Accuracy& accuracy = h.app->accuracy;
  accuracy.wanted[0] = 0.05;
  h.app->desk.tab = Tab::kAccuracy;
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  EXPECT_EQ(accuracy.alpha_search(), nullptr);
  h.press("Find the paper's alpha");
  ASSERT_NE(accuracy.alpha_search(), nullptr);
  accuracy.wanted[0] = 0.06;
  EXPECT_EQ(accuracy.alpha_search(), nullptr) << "it is for another error";
  accuracy.wanted[0] = 0.05;
  for (int i = 0; i < 100000 && !accuracy.alpha_search()->done(); ++i) accuracy.advance(0.05);
  ASSERT_TRUE(accuracy.alpha_search()->choice());
  const AlphaChoice found = *accuracy.alpha_search()->choice();
  EXPECT_LE(*error_of(found.result, ErrorAxis::kTrajectory), 0.05);
  h.frames(2);
  h.press("Run with this alpha");
  EXPECT_EQ(h.app->session.settings().alpha, found.alpha);
  EXPECT_FALSE(h.app->accuracy.busy());
  h.app->session.pause();
  h.app->reset();
  for (std::int64_t f = 0; f < found.result.metrics.work.frames; ++f) h.app->session.step();
  EXPECT_EQ(h.app->session.hash(), found.result.metrics.hash);
  EXPECT_FALSE(h.app->busy());
  EXPECT_EQ(h.app->set("accuracy", "alpha"), "");
  EXPECT_TRUE(h.app->busy());
  ASSERT_EQ(h.app->set("accuracy", "cancel"), "");
  EXPECT_EQ(accuracy.alpha_search(), nullptr);
}

TEST(Accuracy, TheCheapestSettingIsStoredForTheScene) {
  Headless h;
  h.app->open("pendulum");
  std::string remembered;
  h.app->host.remember = [&](const std::string&, const std::string& value) { remembered = value; };
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  ASSERT_EQ(h.app->set("accuracy", "run"), "");
  finish(h);
  h.app->accuracy.wanted[0] = 1e-4;
  h.app->desk.tab = Tab::kAccuracy;
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  const auto found = recommended_of(h.app->accuracy.results(), ErrorAxis::kTrajectory, 1e-4);
  ASSERT_TRUE(found.has_value());
  h.press("Keep for this scene");
  const Scene& kept = h.app->session.scene();
  EXPECT_EQ(kept.name, "pendulum_own");
  EXPECT_EQ(kept.recommended, found);
  EXPECT_EQ(kept.settings, found->settings);
  EXPECT_EQ(h.app->accuracy.scene(), h.app->plain_scene) << "the picture is still of this scene";
  const OwnScenes again = OwnScenes::read(remembered);
  ASSERT_EQ(again.scenes().size(), 1U);
  EXPECT_EQ(again.scenes()[0]->recommended, found);
  EXPECT_EQ(again.scenes()[0]->settings, found->settings);
  // A saved run has the recommendation too, and its preset.
  EXPECT_EQ(h.app->session.as_scene().recommended, found);
  ASSERT_EQ(h.app->set("preset", "paper"), "");
  h.frames(2);
  EXPECT_EQ(h.app->session.settings().integrator, Integrator::kEuler);
  ASSERT_EQ(h.app->set("preset", "recommended"), "");
  Settings settings = h.app->session.settings();
  settings.watch_stiffness = false;
  EXPECT_EQ(settings, found->settings);
}

// The runs of a shipped sweep may be shorter than the scene.
TEST(Accuracy, AKeptSettingHasHeldForTheWholeDurationOfTheScene) {
  Headless h;
  h.app->open("newtons_cradle");
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  Accuracy& accuracy = h.app->accuracy;
  ASSERT_TRUE(accuracy.shipped());
  const double whole = accuracy.scene()->criteria.duration;
  ASSERT_LT(accuracy.experiments().front().duration, whole);
  ASSERT_EQ(accuracy.error, ErrorAxis::kTrajectory);
  const double uncertainty = accuracy.reference()->uncertainty;
  ASSERT_GT(uncertainty, 0.0);
  accuracy.wanted[0] = 9.0 * uncertainty;
  EXPECT_FALSE(accuracy.can_promise());
  accuracy.wanted[0] = 50.0 * uncertainty;
  EXPECT_TRUE(accuracy.can_promise());
  accuracy.try_whole();
  ASSERT_TRUE(accuracy.trying());
  EXPECT_TRUE(accuracy.busy());
  accuracy.cancel_trial();
  EXPECT_FALSE(accuracy.trying());
  h.frames(2);
  EXPECT_EQ(h.app->session.scene().name, "newtons_cradle") << "nothing is kept";
  h.press("Keep for this scene");
  for (int i = 0; i < 100000 && accuracy.trying(); ++i) accuracy.advance(0.05);
  h.frames(2);
  const Scene& kept = h.app->session.scene();
  EXPECT_EQ(kept.name, "newtons_cradle_own");
  ASSERT_TRUE(kept.recommended.has_value());
  EXPECT_NE(kept.recommended->why.find(format_text(" It holds for %g s", whole)), std::string::npos)
      << kept.recommended->why;
}

TEST(Accuracy, SlicesAreBoundedAndCancelStopsAtOnce) {
  Headless h;
  h.app->open("swinging_box");
  h.app->set("accuracy", "run");
  double before = 0.0;
  for (int i = 0; i < 200; ++i) {
    h.app->accuracy.advance(1e-9);  // one frame of one run at most
    EXPECT_LE(h.app->accuracy.progress() - before, 1e-3);
    before = h.app->accuracy.progress();
  }
  EXPECT_GT(before, 0.0);
  ASSERT_EQ(h.app->set("accuracy", "cancel"), "");
  EXPECT_FALSE(h.app->accuracy.running());
  const std::size_t results = h.app->accuracy.results().size();
  h.frames(5);
  EXPECT_EQ(h.app->accuracy.results().size(), results);
  EXPECT_EQ(h.app->accuracy.progress(), before);
  EXPECT_NE(h.app->set("accuracy", "perhaps"), "");
}

TEST(Accuracy, AClickedPointReproducesItsFigures) {
  Headless h;
  h.app->open("pendulum");
  h.app->set("accuracy", "run");
  finish(h);
  const std::vector<Result> results = h.app->accuracy.results();
  h.app->open("free_fall");  // the point also loads its scene
  for (std::size_t i = 0; i < results.size(); i += 20) {
    h.app->run_result(results[i]);
    EXPECT_TRUE(h.app->session.playing());
    h.app->session.pause();
    ASSERT_EQ(h.app->session.scene().name, "pendulum");
    const auto frames = static_cast<int>(results[i].metrics.work.frames);
    for (int f = 0; f < frames; ++f) h.app->session.step();
    EXPECT_EQ(h.app->session.hash(), results[i].metrics.hash) << i;
  }
}

// A click on a point of the chart runs it.
TEST(Accuracy, PointsAreFoundUnderThePointer) {
  Headless h;
  h.app->open("pendulum");
  h.app->set("panel", "accuracy");
  h.app->set("accuracy", "run");
  finish(h);
  h.frames(2);
  std::set<std::string> chosen;
  for (float y = 260.0F; y < 520.0F; y += 12.0F) {
    for (float x = 1000.0F; x < 1260.0F; x += 20.0F) {
      h.click(x, y);
      const Settings& s = h.app->session.settings();
      chosen.insert(series_name(s) + std::to_string(series_parameter(s).value));
    }
  }
  EXPECT_GT(chosen.size(), 10U);
}

TEST(Accuracy, NoPointOfTheFrontIsDominated) {
  Headless h;
  h.app->open("pendulum");
  h.app->set("accuracy", "run");
  finish(h);
  for (const CostAxis cost : {CostAxis::kSubsteps, CostAxis::kOperations, CostAxis::kTime}) {
    h.app->accuracy.cost = cost;
    const auto points = h.app->accuracy.points();
    int on_front = 0;
    for (const auto& p : points) {
      bool beaten = false;
      for (const auto& q : points) {
        beaten = beaten ||
                 (q.cost <= p.cost && q.error <= p.error && (q.cost < p.cost || q.error < p.error));
      }
      EXPECT_EQ(p.front, !beaten);
      on_front += p.front ? 1 : 0;
    }
    EXPECT_GT(on_front, 2);
  }
}

// The top does not move and nothing is solved: energy over sub-steps is the only available chart.
TEST(Accuracy, WithoutConstraintsTheChartIsEnergyOverSubsteps) {
  Headless h;
  Scene scene = *shipped("spinning_top");
  scene.criteria.duration = 0.2;
  h.app->run(std::make_shared<const Scene>(std::move(scene)));
  h.app->set("panel", "accuracy");
  ASSERT_EQ(h.app->accuracy.cost, CostAxis::kOperations);
  h.app->set("accuracy", "run");
  finish(h);
  EXPECT_EQ(h.app->accuracy.error, ErrorAxis::kEnergy);
  EXPECT_EQ(h.app->accuracy.cost, CostAxis::kSubsteps);
  EXPECT_GT(h.app->accuracy.points().size(), 30U);
}

// The legend distinguishes them, and so must the chart.
TEST(Accuracy, NoTwoCurvesOfASceneLookTheSame) {
  const Library library = shipped();
  for (const auto& scene : library.scenes()) {
    std::map<std::array<unsigned, 4>, std::string> looks;
    for (const SweepPoint& point : default_sweep(*scene)) {
      const ui::CurveStyle style = ui::curve_style(ui::dark_theme(), point.settings);
      const std::array<unsigned, 4> look{style.color, static_cast<unsigned>(style.corners),
                                         style.hollow ? 1U : 0U, style.dashed ? 1U : 0U};
      const auto [first, is_new] = looks.emplace(look, style.name());
      EXPECT_EQ(first->second, style.name()) << scene->name;
    }
  }
}

TEST(Accuracy, ThePanelIsDrawnInEveryLayout) {
  Headless h;
  sweep_a_rope(h);
  h.app->measure_costs();
  finish_costs(h);
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, std::pair{1920.0F, 1080.0F},
                                      std::pair{390.0F, 844.0F}, std::pair{844.0F, 390.0F}}) {
    h.resize(width, height, 2.0F);
    for (const int shown : {0, 1, 2, 3, 4}) {
      const bool large = shown % 2 == 1;
      h.app->accuracy.picture = static_cast<AccuracyPicture>(shown / 2);
      h.app->desk.accuracy_large = large;
      h.frames(3);
      const ImGuiWindow* card = ImGui::FindWindowByName("##accuracy");
      const bool drawn = card != nullptr && card->Active;
      EXPECT_EQ(drawn, large && width >= 900.0F) << width;
      if (drawn) {
        const ViewRect& v = h.app->view_rect;
        EXPECT_GE(card->Pos.x, v.x);
        EXPECT_LE(card->Pos.x + card->Size.x, v.x + v.width);
        EXPECT_LE(card->Pos.y + card->Size.y, v.y + v.height);
        EXPECT_GT(card->Size.x, 300.0F) << "larger than in the panel";
        const ui::Handle* tour = find_handle("Tour");
        ASSERT_NE(tour, nullptr);
        EXPECT_LE(card->Pos.y + card->Size.y, tour->min.y) << "what lies below it can be pressed";
      }
    }
    EXPECT_EQ(h.app->desk.tab, Tab::kAccuracy);
  }
}

}  // namespace
}  // namespace substep
