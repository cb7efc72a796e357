// "What does accuracy cost?" in the window: a sweep in slices, and points that run.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/lab/presets.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

/// Until the sweep is done.
void finish(Headless& h) {
  h.app->session.pause();
  for (int i = 0; i < 20000 && h.app->accuracy.running(); ++i) h.frames(1);
}

TEST(Accuracy, TheSweepGrowsWhileTheWindowLives) {
  Headless h;
  h.app->open("pendulum");
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.frames(3);
  EXPECT_EQ(h.app->accuracy.planned(), 0U) << "nothing runs unasked";
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
  EXPECT_GT(stages, 5U) << "the picture grows, it does not come at once";
  EXPECT_GT(h.app->accuracy.points().size(), 50U);
  std::set<std::string> series;
  for (const Result& r : h.app->accuracy.results()) {
    series.insert(series_name(r.experiment.settings));
  }
  EXPECT_GE(series.size(), 12U);
}

TEST(Accuracy, TheCheapestWithinAnErrorRunsAtAPress) {
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

TEST(Accuracy, TheMostExactWithinACostIsLookedForAtAPress) {
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

// Frames at 60 Hz wait for the screen. One that came late must not make the next ones late.
TEST(Accuracy, TakesAShareOfSlowFramesAndLetsOthersRecover) {
  for (const bool plays : {false, true}) {
    const double least = Accuracy::slice(plays, 1.0 / 60.0);
    for (const double drawing : {0.002, 0.005, 0.008}) {
      double wall = 0.1;  // a hiccup
      double own = least;
      for (int i = 0; i < 10; ++i) {
        own = Accuracy::slice(plays, wall - own);
        wall = std::ceil((drawing + own) * 60.0) / 60.0;
      }
      EXPECT_EQ(own, least);
    }
    EXPECT_GT(Accuracy::slice(plays, 0.1), 0.015) << "a page without a graphics processor";
    EXPECT_LT(Accuracy::slice(plays, 0.1), 0.1);
    EXPECT_LT(Accuracy::slice(plays, 1e6), 0.2) << "a tab that slept";
  }
}

TEST(Accuracy, FindsThePapersAlphaForWhatIsWanted) {
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

TEST(Accuracy, WhatIsFoundIsKeptForTheScene) {
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
  // A saved run has it too, and its preset.
  EXPECT_EQ(h.app->session.as_scene().recommended, found);
  ASSERT_EQ(h.app->set("preset", "paper"), "");
  h.frames(2);
  EXPECT_EQ(h.app->session.settings().integrator, Integrator::kEuler);
  ASSERT_EQ(h.app->set("preset", "recommended"), "");
  Settings settings = h.app->session.settings();
  settings.watch_stiffness = false;
  EXPECT_EQ(settings, found->settings);
}

TEST(Accuracy, NoSliceRunsAheadAndCancelStopsAtOnce) {
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

TEST(Accuracy, AChosenPointGivesItsFiguresAgain) {
  Headless h;
  h.app->open("pendulum");
  h.app->set("accuracy", "run");
  finish(h);
  const std::vector<Result> results = h.app->accuracy.results();
  h.app->open("free_fall");  // the point brings its scene along
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

// A click on the picture where a point lies runs that point.
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

/// Three links under a heavy box, for half a second: quick, and bodies of different mass.
void sweep_a_rope(Headless& h) {
  Scene scene = scenes::rope_of_n({.n = 3});
  scene.criteria.duration = 0.5;
  h.app->run(std::make_shared<const Scene>(std::move(scene)));
  h.app->set("panel", "accuracy");
  h.app->set("accuracy", "run");
  finish(h);
}

TEST(Accuracy, TheMapComesLastAndACellGivesItsFiguresAgain) {
  Headless h;
  sweep_a_rope(h);
  ASSERT_TRUE(h.app->accuracy.has_map());
  const std::vector<Result> results = h.app->accuracy.results();
  const auto is_varied = [](const Result& r) { return r.experiment.load != 1.0; };
  const auto first = std::find_if(results.begin(), results.end(), is_varied);
  EXPECT_TRUE(std::all_of(first, results.end(), is_varied)) << "the curves come first";
  for (const auto& point : h.app->accuracy.points()) {
    EXPECT_EQ(results[point.result].experiment.load, 1.0);
  }
  int failed = 0;
  for (auto r = first; r < results.end(); r += 3) {
    h.app->run_result(*r);
    h.app->session.pause();
    EXPECT_EQ(h.app->load, r->experiment.load);
    for (std::int64_t f = 0; f < r->metrics.work.frames; ++f) h.app->session.step();
    EXPECT_EQ(h.app->session.hash(), r->metrics.hash) << r->experiment.load;
    failed += r->metrics.holds ? 0 : 1;
  }
  EXPECT_GT(failed, 0) << "of a map where all holds no cell tells anything";
  h.app->run_result(results.front());
  EXPECT_EQ(h.app->load, 1.0);
}

TEST(Accuracy, CellsOfTheMapAreFoundUnderThePointer) {
  Headless h;
  sweep_a_rope(h);
  h.app->accuracy.picture = AccuracyPicture::kStabilityMap;
  h.frames(2);
  std::set<std::pair<double, double>> chosen;  // load and parameter
  for (float y = 240.0F; y < 660.0F; y += 11.0F) {
    for (float x = 1000.0F; x < 1260.0F; x += 20.0F) {
      h.click(x, y);
      chosen.insert({h.app->load, series_parameter(h.app->session.settings()).value});
    }
  }
  std::set<double> loads;
  for (const auto& [load, value] : chosen) loads.insert(load);
  EXPECT_EQ(loads.size(), 6U);
  EXPECT_GT(chosen.size(), 40U);
}

/// Half a second of the bridge: rows of every kind.
std::shared_ptr<const Scene> short_bridge() {
  Scene scene = *shipped("bridge");
  scene.criteria.duration = 0.5;
  return std::make_shared<const Scene>(std::move(scene));
}

/// Until the costs of effects are measured.
void finish_costs(Headless& h) {
  for (int i = 0; i < 20000 && h.app->accuracy.effects.running(); ++i) h.frames(1);
}

TEST(EffectCosts, SlicesGiveWhatOneGoGives) {
  Headless h;
  h.app->run(short_bridge());
  h.app->session.pause();
  h.app->set("panel", "accuracy");
  h.frames(3);
  h.press("Stages");
  EXPECT_FALSE(h.app->accuracy.effects.running()) << "nothing runs unasked";
  h.press("Measure this run");
  ASSERT_TRUE(h.app->accuracy.effects.running());
  finish_costs(h);
  const CostBreakdown* sliced = h.app->costs();
  ASSERT_NE(sliced, nullptr);
  const CostBreakdown whole =
      cost_of_effects(*h.app->plain_scene, *h.app->accuracy.effects.experiment());
  EXPECT_EQ(sliced->run.work, whole.run.work);
  EXPECT_EQ(sliced->run.work.frames, 30);
  ASSERT_EQ(sliced->effects.size(), whole.effects.size());
  for (std::size_t i = 0; i < whole.effects.size(); ++i) {
    EXPECT_EQ(sliced->effects[i].effect, whole.effects[i].effect);
    EXPECT_EQ(sliced->effects[i].flops, whole.effects[i].flops);
    EXPECT_NE(find_handle(whole.effects[i].effect), nullptr) << "each has its bar";
  }
  EXPECT_NE(find_handle("criterion"), nullptr);
}

TEST(EffectCosts, NoSliceRunsAheadAndTheyAreOfOneSettingAlone) {
  Headless h;
  h.app->open("swinging_box");
  h.app->session.pause();
  ASSERT_EQ(h.app->set("accuracy", "measure"), "");
  for (int i = 0; i < 12; ++i) {
    h.app->accuracy.advance(1e-9);  // one frame of one simulator at most
    EXPECT_LE(h.app->accuracy.effects.progress(), (i + 3.0) / 3.0 / 600.0);
  }
  EXPECT_GT(h.app->accuracy.effects.progress(), 0.0);
  EXPECT_NE(h.app->costs(), nullptr) << "the picture grows";
  h.app->set("alpha", "0.2");
  EXPECT_EQ(h.app->costs(), nullptr) << "of other settings";
  h.app->set("alpha", "0.1");
  EXPECT_NE(h.app->costs(), nullptr);
  ASSERT_EQ(h.app->set("accuracy", "cancel"), "");
  const double share = h.app->accuracy.effects.progress();
  h.frames(5);
  EXPECT_EQ(h.app->accuracy.effects.progress(), share);
  h.app->open("pendulum");
  EXPECT_EQ(h.app->costs(), nullptr) << "of another scene";
}

TEST(EffectCosts, SwitchesMeasureTheirOwn) {
  Headless h(1280.0F, 1400.0F);
  h.app->run(short_bridge());
  h.app->session.pause();
  h.app->session.step();
  h.app->desk.more = true;
  h.frames(3);
  h.press("Measure what each adds");
  finish_costs(h);
  ASSERT_NE(h.app->costs(), nullptr);
  h.frames(2);
  EXPECT_EQ(find_handle("Measure what each adds"), nullptr) << "it is known";
  h.press("friction");
  EXPECT_FALSE(h.app->session.scene().effects.friction);
  h.press("friction");
  EXPECT_TRUE(h.app->session.scene().effects.friction);
}

TEST(Settings, WhatActsAtAStartAloneSaysSo) {
  Headless h;
  h.app->open("swinging_box");
  h.app->session.pause();
  ASSERT_EQ(h.app->set("probe", "false"), "");
  EXPECT_EQ(h.app->notice.text, "") << "it has not begun";
  h.app->session.step();
  ASSERT_EQ(h.app->set("alpha", "0.2"), "");
  EXPECT_EQ(h.app->notice.text, "") << "acts live";
  ASSERT_EQ(h.app->set("probe", "true"), "");
  EXPECT_NE(h.app->notice.text.find("reset"), std::string::npos);
}

TEST(Presets, AButtonSetsAllOfTheMethodAndTheLinkKeepsIt) {
  Headless h;
  h.app->open("bridge");
  h.app->set("solver", "pgs");
  h.app->desk.view.tint = true;
  h.frames(3);
  h.press("recommended");
  ASSERT_TRUE(h.app->session.scene().recommended.has_value());
  Settings recommended = h.app->session.scene().recommended->settings;
  recommended.watch_stiffness = true;  // what is looked at stays
  EXPECT_EQ(h.app->session.settings(), recommended);
  const std::string link = h.app->link();
  h.press("paper");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  h.app->open_link(link);
  EXPECT_EQ(h.app->session.settings(), recommended);
  EXPECT_EQ(h.app->set("preset", "paper"), "");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  EXPECT_NE(h.app->set("preset", "fastest"), "");
}

TEST(Accuracy, TheFrontHasNoPointThatAnotherBeats) {
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
      }
    }
    EXPECT_EQ(h.app->desk.tab, Tab::kAccuracy);
  }
}

}  // namespace
}  // namespace substep
