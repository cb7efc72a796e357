// "Find N": the same answer as `substep recommend`, for scenes that are not shipped, and its panel.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"
#include "core/model/format_text.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

/// A scene under a name of its own, as short as a test wants it.
Scene own_scene(Scene scene, const std::string& name, double seconds) {
  scene.name = name;
  scene.recommended.reset();
  scene.criteria.duration = seconds;
  return scene;
}

void complete(FindN& find) {
  while (find.busy()) find.advance(0.05);
}

FindN answer_for(const Scene& scene, ErrorAxis axis, double limit) {
  FindN find;
  find.start({std::make_shared<const Scene>(scene)}, axis, limit);
  complete(find);
  return find;
}

Scene short_rope(int n = 3) { return own_scene(scenes::rope_of_n({.n = n}), "short_rope", 0.5); }

/// Any gap of a joint fails, so every run does.
Scene hopeless() {
  Scene scene = short_rope();
  scene.name = "hopeless";
  scene.criteria.joint_gap = 1e-15;
  return scene;
}

#ifdef SUBSTEP_PROGRAM
struct Asked {
  Scene scene;
  ErrorAxis axis;
  double limit;
};

std::vector<Asked> not_shipped() {
  std::vector<Asked> all;
  const auto add = [&](Scene scene, const char* name, double seconds, ErrorAxis axis,
                       double limit) {
    all.push_back({own_scene(std::move(scene), name, seconds), axis, limit});
  };
  add(scenes::rope_of_n({.n = 3}), "rope_3", 1.0, ErrorAxis::kTrajectory, 1e-3);
  add(scenes::rope_of_n({.n = 6, .end_mass = 20.0}), "rope_6", 0.5, ErrorAxis::kTrajectory, 1e-2);
  add(scenes::rope_of_n({.n = 4, .compliance = 1e-6}), "soft_rope", 0.5, ErrorAxis::kGap, 1e-3);
  add(scenes::bridge({.ball_x = -2.0, .ball_speed = 1.0}), "slow_bridge", 0.1, ErrorAxis::kGap,
      1e-3);
  add(scenes::heavy_stack({.layers = 1, .top_mass = 50.0}), "low_stack", 0.2,
      ErrorAxis::kPenetration, 1e-4);
  add(scenes::spherical_pendulum(), "spherical_own", 0.5, ErrorAxis::kEnergy, 1e-2);
  add(scenes::pendulum(), "moon_pendulum", 2.0, ErrorAxis::kTrajectory, 1e-4);
  all.back().scene.gravity *= 0.165;
  add(scenes::whirling_chain(), "untracked_chain", 0.3, ErrorAxis::kTrajectory, 1e-3);
  all.back().scene.criteria.track.reset();
  add(scenes::heavy_top(), "slow_top", 0.3, ErrorAxis::kTrajectory, 1e-3);
  add(scenes::pendulum(), "strict_pendulum", 1.0, ErrorAxis::kTrajectory, 1e-13);
  return all;
}

constexpr const char* kAxisWords[] = {"path", "energy", "gap", "overlap"};

/// What `substep recommend` prints for the same text.
std::string recommend(const std::string& text, const Asked& asked) {
  const std::filesystem::path folder = testing::TempDir();
  const std::string file = (folder / (asked.scene.name + ".json")).string();
  const std::string out = (folder / (asked.scene.name + ".out")).string();
  std::ofstream(file) << text;
  const std::string command = "\"" SUBSTEP_PROGRAM "\" recommend \"" + file + "\" --jobs 2 --of " +
                              kAxisWords[static_cast<std::size_t>(asked.axis)] +
                              format_text(" --error %.17g", asked.limit) + " >\"" + out + "\" 2>&1";
  std::system(command.c_str());  // the exit code says whether the error is reached
  std::ifstream stream(out);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string as_printed(const Result& result, ErrorAxis axis) {
  const Settings& s = result.experiment.settings;
  const SeriesParameter parameter = series_parameter(s);
  return format_text("%s, %s = %g: %.3g %s for %.3g operations per frame", series_name(s).c_str(),
                     parameter.name, parameter.value, error_of(result, axis).value_or(0.0),
                     unit_of(axis), cost_of(result, CostAxis::kOperations));
}

TEST(FindN, AgreesWithRecommendOnTheSameText) {
  std::size_t ended_early = 0;
  for (const Asked& asked : not_shipped()) {
    const std::string text = write_scene(asked.scene);
    const SceneResult read = read_scene(text);
    ASSERT_TRUE(read.scene) << asked.scene.name;
    const FindN find = answer_for(*read.scene, asked.axis, asked.limit);
    const std::string said = recommend(text, asked);
    const std::string context = asked.scene.name + ":\n" + said + find.failure();
    if (find.best() != nullptr) {
      EXPECT_NE(said.find("The cheapest within "), std::string::npos) << context;
      EXPECT_NE(said.find(": " + as_printed(*find.best(), asked.axis)), std::string::npos)
          << as_printed(*find.best(), asked.axis) << "\n"
          << context;
      ended_early += find.count().error + find.count().cost;
    } else if (find.nearest() != nullptr && find.failed().empty()) {
      EXPECT_NE(said.find("The nearest: " + as_printed(*find.nearest(), asked.axis)),
                std::string::npos)
          << as_printed(*find.nearest(), asked.axis) << "\n"
          << context;
    } else {
      EXPECT_EQ(said.find("The cheapest within "), std::string::npos) << context;
    }
  }
  EXPECT_GT(ended_early, 100U) << "not all runs are needed";
}
#endif

TEST(FindN, TheSubStepsAlongAlphaAreThoseOfWholeRuns) {
  const FindN find = answer_for(short_rope(), ErrorAxis::kTrajectory, 1e-3);
  const auto points = find.along_alpha();
  ASSERT_GT(points.size(), 8U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FindN::AlphaPoint& before = points[i > 0 ? i - 1 : 0];
    EXPECT_TRUE(i == 0 || points[i].alpha < before.alpha);
    EXPECT_GE(points[i].n, before.n);
    EXPECT_TRUE(points[i].error.has_value());
    ExperimentRun run(*find.scene(), points[i].result->experiment, find.reference());
    while (run.advance()) {
    }
    EXPECT_EQ(run.result().metrics.hash, points[i].result->metrics.hash);
    EXPECT_EQ(cost_of(run.result(), CostAxis::kSubsteps), points[i].n);
  }
}

// The second search keeps complete runs; those that ended early may matter again.
TEST(FindN, AnotherLimitOnTheSameSceneAnswersAsAFreshSearch) {
  FindN find = answer_for(short_rope(), ErrorAxis::kTrajectory, 1e-3);
  for (const double limit : {1e-5, 1e-1, 1e-3}) {
    find.start(FindScene(find.of()), ErrorAxis::kTrajectory, limit);
    complete(find);
    const FindN fresh = answer_for(short_rope(), ErrorAxis::kTrajectory, limit);
    ASSERT_NE(find.best(), nullptr) << limit;
    ASSERT_NE(fresh.best(), nullptr) << limit;
    EXPECT_EQ(find.best()->experiment, fresh.best()->experiment) << limit;
    EXPECT_EQ(find.best()->metrics.hash, fresh.best()->metrics.hash) << limit;
  }
}

TEST(FindN, CancelKeepsWhatItHasAndASecondStartFinishes) {
  FindN find;
  const FindScene of{std::make_shared<const Scene>(short_rope())};
  find.start(of, ErrorAxis::kGap, 1e-3);
  while (find.busy() && find.count().complete < 20) find.advance(0.0);
  find.cancel();
  EXPECT_FALSE(find.busy());
  const FindN::Count before = find.count();
  find.advance(1.0);
  EXPECT_EQ(find.count().complete, before.complete);
  EXPECT_EQ(find.best(), nullptr) << "an answer needs all runs";
  ASSERT_FALSE(find.along_alpha().empty());
  find.start(of, ErrorAxis::kGap, 1e-3);
  EXPECT_EQ(find.count().complete, before.complete);
  complete(find);
  const FindN fresh = answer_for(short_rope(), ErrorAxis::kGap, 1e-3);
  ASSERT_NE(find.best(), nullptr);
  EXPECT_EQ(find.best()->experiment.settings, fresh.best()->experiment.settings);
}

TEST(FindN, AFailingSceneHasNoAnswerAndSaysSo) {
  const FindN find = answer_for(hopeless(), ErrorAxis::kGap, 1e-3);
  EXPECT_EQ(find.stage(), FindN::Stage::kDone);
  EXPECT_EQ(find.best(), nullptr);
  EXPECT_EQ(find.nearest(), nullptr);
  EXPECT_EQ(find.count().held, 0U);
  EXPECT_GT(find.count().complete, 100U);
  for (const FindN::AlphaPoint& point : find.along_alpha()) EXPECT_FALSE(point.holds);
  const FindN path = answer_for(hopeless(), ErrorAxis::kTrajectory, 1e-3);
  EXPECT_EQ(path.best(), nullptr);
}

TEST(FindN, AStillSceneHasNoPath) {
  Scene scene = short_rope();
  scene.criteria.track.reset();
  for (Body& body : scene.bodies) body.is_static = true;
  const FindN find = answer_for(scene, ErrorAxis::kTrajectory, 1e-3);
  EXPECT_EQ(find.best(), nullptr);
  EXPECT_FALSE(find.failure().empty());
  EXPECT_FALSE(find.busy());
}

/// Opens the scene in the window and starts the search with the button of a panel.
void press_find_n(Headless& h, const Scene& scene) {
  ASSERT_TRUE(h.app->open_text(write_scene(scene), "mine.json"));
  h.app->session.pause();
  ASSERT_EQ(h.app->set("panel", "why"), "");
  h.frames(3);
  h.press("Find N");
}

TEST(FindNPanel, OneButtonFindsAndAnotherRunsTheAnswer) {
  Headless h;
  press_find_n(h, short_rope());
  EXPECT_EQ(h.app->desk.tab, Tab::kAccuracy);
  EXPECT_TRUE(h.app->busy());
  FindN& find = h.app->find_n;
  double before = 0.0;
  bool early = false;
  for (int i = 0; i < 100000 && find.busy(); ++i) {
    h.frames(1);
    EXPECT_GE(find.progress(), before);
    before = find.progress();
    early = early || (find.busy() && !find.along_alpha().empty());
  }
  EXPECT_TRUE(early) << "results are shown before the end";
  EXPECT_FALSE(find.busy());
  ASSERT_NE(find.best(), nullptr);
  const Result best = *find.best();
  h.resize(1280.0F, 1600.0F, 1.0F);  // all of the panel
  h.frames(3);
  h.press("Run it");
  EXPECT_TRUE(h.app->session.playing());
  h.app->session.pause();
  h.app->reset();
  for (std::int64_t f = 0; f < best.metrics.work.frames; ++f) h.app->session.step();
  EXPECT_EQ(h.app->session.hash(), best.metrics.hash);
}

TEST(FindNPanel, AChangedSceneLeavesTheSearchToItsOwn) {
  Headless h;
  press_find_n(h, short_rope());
  FindN& find = h.app->find_n;
  h.frames(5);
  const std::string name = find.of().plain->name;
  ASSERT_TRUE(find.busy());
  h.app->open("pendulum");
  for (int i = 0; i < 100000 && find.busy(); ++i) h.frames(1);
  EXPECT_EQ(find.of().plain->name, name);
  ASSERT_NE(find.best(), nullptr);
  const Result best = *find.best();
  h.app->run_found(best);
  EXPECT_EQ(h.app->session.scene().name, name);
  h.app->session.pause();
  for (std::int64_t f = 0; f < best.metrics.work.frames; ++f) h.app->session.step();
  EXPECT_EQ(h.app->session.hash(), best.metrics.hash);
}

TEST(FindNPanel, IsOfTheLoadThatRuns) {
  Headless h;
  ASSERT_TRUE(h.app->open_text(write_scene(short_rope()), "mine.json"));
  h.app->session.pause();
  h.app->vary(0.1, 0);
  h.app->start_find_n();
  const FindN& find = h.app->find_n;
  EXPECT_EQ(find.of(), h.app->find_scene());
  while (h.app->find_n.busy()) h.app->find_n.advance(0.05);
  ASSERT_NE(find.best(), nullptr);
  const Result best = *find.best();
  h.app->vary(1.0, 0);
  EXPECT_NE(find.of(), h.app->find_scene());
  h.app->run_found(best);
  EXPECT_EQ(h.app->load, 0.1);
  h.app->session.pause();
  for (std::int64_t f = 0; f < best.metrics.work.frames; ++f) h.app->session.step();
  EXPECT_EQ(h.app->session.hash(), best.metrics.hash);
}

TEST(FindNPanel, IsDrawnInEveryStateAndLayout) {
  const std::function<void(Headless&)> states[] = {
      [](Headless&) {}, [](Headless& h) { h.app->set("accuracy", "find"); },
      [](Headless& h) {
        h.app->set("accuracy", "find");
        while (h.app->find_n.along_alpha().size() < 3) h.app->find_n.advance(0.0);
        h.app->set("accuracy", "cancel");
      },
      [](Headless& h) {
        h.app->set("accuracy", "find");
        complete(h.app->find_n);
      },
      [](Headless& h) {
        h.app->open_text(write_scene(hopeless()), "hopeless.json");
        h.app->set("accuracy", "find");
        complete(h.app->find_n);
      }};
  for (const auto& state : states) {
    Headless h;
    ASSERT_TRUE(h.app->open_text(write_scene(short_rope()), "mine.json"));
    h.app->session.pause();
    h.app->set("panel", "accuracy");
    h.app->accuracy.picture = AccuracyPicture::kFindN;
    state(h);
    for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, std::pair{390.0F, 844.0F}}) {
      for (const bool dark : {true, false}) {
        h.app->desk.dark = dark;
        h.resize(width, height, 2.0F);
        h.frames(2);
        EXPECT_NE(find_handle("Find N"), nullptr);
        for (const ui::Handle& handle : ui::handles()) EXPECT_LE(handle.max.x, width + 1.0F);
      }
    }
  }
}

}  // namespace
}  // namespace substep
