// The recommended setting of a scene: stored in its file, used at the start, and reproducible.

#include "core/model/recommended.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/io/experiment.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/presets.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"
#include "core/lab/verdict_table.hpp"
#include "scenes/generator/recommended.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

using test::kGood;
using test::List;
using test::problems_of;
using test::with;

const std::string kSettings =
    R"("settings": {"solver": "bpp", "alpha": 0.1, "n": 16, "probe": true})";
const std::string kRecommended =
    R"("recommended": {"of": "path", "within": 0.001, "reached": 0.0005, "operations": 1200,
     "seconds": 2, "why": "It is cheap.", "settings": {"mode": "const", "n": 7}})";

Recommended some_recommended() {
  return {.settings = PaperSettings{.mode = Mode::kConst, .n = 7},
          .of = ErrorAxis::kTrajectory,
          .within = 0.001,
          .reached = 0.0005,
          .operations = 1200.0,
          .seconds = 2.0,
          .why = "It is cheap."};
}

std::shared_ptr<const Scene> scene_of(const std::string& text) {
  EXPECT_EQ(problems_of(text), List{});
  return read_scene(text).scene;
}

TEST(Recommended, IsTheStartOfASceneWithoutSettings) {
  const auto scene = scene_of(with(kSettings, kRecommended));
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->recommended, some_recommended());
  EXPECT_EQ(scene->settings, some_recommended().settings);
  EXPECT_EQ(own_settings(*scene), PaperSettings{});
}

TEST(Recommended, DoesNotReplaceTheSettingsOfAScene) {
  const std::string own = R"("settings": {"solver": "pgs"}, )";
  const auto scene = scene_of(with(kSettings, own + kRecommended));
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->recommended, some_recommended());
  EXPECT_EQ(scene->settings, PaperSettings{.solver = SolverKind::kPgs})
      << "omitted settings have the default, not the recommended value";
  EXPECT_EQ(own_settings(*scene), scene->settings);
  // An empty block chooses nothing.
  EXPECT_EQ(scene_of(with(kSettings, R"("settings": {}, )" + kRecommended))->settings,
            some_recommended().settings);
}

TEST(Recommended, IsWrittenBackToTheSameBytes) {
  for (const std::string& text :
       {with(kSettings, kRecommended), with(kSettings, kSettings + ", " + kRecommended)}) {
    const auto scene = scene_of(text);
    ASSERT_NE(scene, nullptr);
    const std::string written = write_scene(*scene);
    const auto read = scene_of(written);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->recommended, scene->recommended);
    EXPECT_EQ(read->settings, scene->settings);
    EXPECT_EQ(write_scene(*read), written);
  }
}

TEST(Recommended, NamesPlaceValueAndRangeOfAProblem) {
  const auto problems = [](const std::string& passage, const std::string& replacement) {
    return problems_of(with(kSettings, with(passage, replacement, kRecommended)));
  };
  EXPECT_EQ(problems(R"("of": "path")", R"("of": "speed")"),
            List{"/recommended/of: must be path, energy, gap or overlap, not \"speed\""});
  EXPECT_EQ(problems(R"("within": 0.001)", R"("within": 0)"),
            List{"/recommended/within: must be above 0 (m, J), not 0"});
  EXPECT_EQ(problems(R"("reached": 0.0005)", R"("reached": 0.002)"),
            List{"/recommended/reached: 0.002 is more than within, 0.001"});
  EXPECT_EQ(problems(R"("operations": 1200)", R"("operations": -1)"),
            List{"/recommended/operations: must be above 0, not -1"});
  EXPECT_EQ(problems(R"("seconds": 2)", R"("seconds": 1e9)"),
            List{"/recommended/seconds: must be at most 86400 (s), not 1e9"});
  EXPECT_EQ(problems(R"("why")", R"("because")"),
            List{"/recommended/because: unknown key (known here: of, within, reached, operations, "
                 "seconds, why or settings)"});
  EXPECT_EQ(problems(R"("n": 7)", R"("n": 0)"),
            List{"/recommended/settings/n: must be a whole number from 1 to 10000, not 0"});
  EXPECT_EQ(problems(R"(, "settings": {"mode": "const", "n": 7})", ""),
            List{"/recommended/settings: missing"});
  EXPECT_EQ(problems_of(with(kSettings, R"("recommended": 3)")),
            List{"/recommended: must be an object, not 3"});
}

TEST(Recommended, IsNotInTheHashOfTheScene) {
  Scene scene = scenes::pendulum();
  const std::uint64_t before = scene_hash(scene);
  scene = with_recommended(std::move(scene), some_recommended());
  EXPECT_EQ(scene_hash(scene), before);
}

TEST(Recommended, SetsTheStartOfASceneWithoutSettings) {
  Scene scene = with_recommended(scenes::pendulum(), some_recommended());
  EXPECT_EQ(scene.settings, some_recommended().settings);
  // An earlier recommendation does not count as the scene's own settings.
  Recommended other = some_recommended();
  other.settings.n = 9;
  scene = with_recommended(std::move(scene), other);
  EXPECT_EQ(scene.settings.n, 9);
  const Scene cradle = with_recommended(scenes::newtons_cradle(), some_recommended());
  EXPECT_EQ(cradle.settings, scenes::newtons_cradle().settings);
}

// Otherwise a recommendation would change the sweep, and thereby the next recommendation.
TEST(Recommended, DoesNotChangeTheSweep) {
  Scene plain = scenes::bridge();
  plain.verdicts = {Expectation{}};
  Recommended recommended = some_recommended();
  recommended.settings = PaperSettings{.solver = SolverKind::kPgs,
                                       .iterations = 64,
                                       .share_iterations = true,
                                       .alpha = 0.7,
                                       .n_cap = 9,
                                       .integrator = Integrator::kLeapfrog,
                                       .detection = Detection::kFrame};
  Scene scene = with_recommended(plain, recommended);
  ASSERT_EQ(scene.settings, recommended.settings);
  scene.settings.watch_stiffness = true;  // display only
  const auto runs = default_sweep(scene);
  const auto before = default_sweep(plain);
  ASSERT_EQ(runs.size(), before.size());
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i].settings, before[i].settings);
  const auto table = verdict_table(scene);
  const auto table_before = verdict_table(plain);
  ASSERT_EQ(table.size(), table_before.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(table[i].settings, table_before[i].settings);
  }
}

Result run_of(const Settings& settings, double flops, double error, bool holds = true) {
  Result result;
  result.experiment.settings = settings;
  result.experiment.duration = 3.0;
  result.metrics.work.frames = 10;
  result.metrics.work.flops = static_cast<std::int64_t>(10.0 * flops);
  result.metrics.errors.trajectory_peak = error;
  result.metrics.holds = holds;
  return result;
}

TEST(Recommended, IsTheCheapestWithinTheError) {
  const PaperSettings leapfrog{.mode = Mode::kConst, .n = 3, .integrator = Integrator::kLeapfrog};
  std::vector<Result> results{
      run_of(PaperSettings{.alpha = 0.1}, 50.0, 2e-3),
      run_of(PaperSettings{.alpha = 0.05}, 6512.3, 8e-4), run_of(leapfrog, 100.049, 4.1234e-4),
      run_of(PaperSettings{.mode = Mode::kNone}, 10.0, 1e-5, false),
      run_of(PaperSettings{.alpha = 0.2, .contact_stiffness = ContactStiffness::kExact}, 600.0,
             8e-4)};
  auto found = recommended_of(results, ErrorAxis::kTrajectory, 1e-3);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->settings, leapfrog);
  EXPECT_EQ(found->within, 1e-3);
  EXPECT_EQ(found->reached, 4.12e-4);
  EXPECT_EQ(found->operations, 100.0);
  EXPECT_EQ(found->seconds, 3.0);
  EXPECT_EQ(
      found->why,
      "The cheapest of 5 runs, 4 of which hold; the paper's method takes 65 times the work, with "
      "alpha 0.05.");
  found = recommended_of(results, ErrorAxis::kTrajectory, 2e-3);
  EXPECT_EQ(found->why, "The cheapest of 5 runs, 4 of which hold; it is the paper's method.");
  found = recommended_of(results, ErrorAxis::kTrajectory, 4.1235e-4);
  EXPECT_LE(found->reached, found->within);
  EXPECT_EQ(
      found->why,
      "The cheapest of 5 runs, 4 of which hold; no run of the paper's method reaches this error.");
  EXPECT_FALSE(recommended_of(results, ErrorAxis::kTrajectory, 1e-4).has_value());
  EXPECT_FALSE(recommended_of(results, ErrorAxis::kEnergy, 1e9).has_value())
      << "it was not measured";
}

TEST(Recommended, PassesOverRunsThatFailedLater) {
  const std::vector<Result> results{run_of(PaperSettings{.alpha = 0.1}, 300.0, 2e-4),
                                    run_of(PaperSettings{.alpha = 0.2}, 200.0, 3e-4),
                                    run_of(PaperSettings{.alpha = 0.3}, 100.0, 4e-4)};
  const auto of = [&](const Tried& tried) {
    return recommended_of(results, ErrorAxis::kTrajectory, 1e-3, tried);
  };
  const std::string plain = "The cheapest of 3 runs, 3 of which hold; it is the paper's method.";
  EXPECT_EQ(of({3.0, 0})->why, plain) << "no longer than the compared runs";
  EXPECT_EQ(of({10.0, 0})->why, plain + " It holds for 10 s.");
  EXPECT_EQ(of({10.0, 0})->seconds, 3.0) << "the time of its error and cost";
  EXPECT_EQ(of({10.0, 1})->settings.alpha, 0.2);
  EXPECT_EQ(of({10.0, 1})->reached, 3e-4);
  EXPECT_EQ(of({10.0, 2})->settings.alpha, 0.1);
  EXPECT_FALSE(of({10.0, 3}).has_value());
  const std::string held = of({10.0, 2})->why;
  EXPECT_NE(held.find(" It holds for 10 s, 2 cheaper ones do not."), std::string::npos) << held;
}

TEST(Recommended, IsThePresetOfItsScene) {
  const Scene scene = with_recommended(scenes::pendulum(), some_recommended());
  const auto presets = presets_for(scene);
  ASSERT_EQ(presets.size(), 4U);
  EXPECT_EQ(presets[1].settings, some_recommended().settings);
  EXPECT_EQ(presets[1].about,
            "For this scene: keeps the path within 1 mm over 2 s, for 1.2 thousand solver "
            "operations per frame. It is cheap.");
  EXPECT_EQ(settings_for(*find_preset("recommended"), scene), some_recommended().settings);
  EXPECT_EQ(settings_for(*find_preset("paper"), scene), PaperSettings{});
  const auto generic = presets_for(scenes::pendulum());
  EXPECT_EQ(generic[1].settings, find_preset("recommended")->settings);
  EXPECT_EQ(generic[1].about, find_preset("recommended")->about);
}

TEST(Recommended, ExistsForEveryShippedSceneWithConstraints) {
  Problems problems;
  const auto kept = scenes::recommendations(problems);
  for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
  std::set<std::string> without;
  std::size_t with = 0;
  for (const Scene& scene : scenes::shipped()) {
    const scenes::Wanted* wanted = scenes::wanted_of(scene.name);
    if (wanted == nullptr) {
      EXPECT_FALSE(scene.recommended.has_value()) << scene.name;
      without.insert(scene.name);
      continue;
    }
    ++with;
    ASSERT_TRUE(scene.recommended.has_value()) << scene.name;
    EXPECT_EQ(scene.recommended->of, wanted->of) << scene.name;
    EXPECT_EQ(scene.recommended->within, wanted->within) << scene.name;
    EXPECT_NEAR(scene.recommended->seconds, wanted->seconds, 1e-12) << scene.name;
  }
  EXPECT_EQ(kept.size(), with) << "recommended.json has a scene that is not shipped";
  EXPECT_EQ(without, (std::set<std::string>{"free_fall", "spinning_top"}));
}

// The scenes of the paper show its settings; the small and the playground scenes start with their
// recommendation, except for the two that demonstrate a setting of their own.
TEST(Recommended, IsTheStartOfTheSmallAndThePlaygroundScenes) {
  std::set<std::string> own;
  for (const Scene& scene : scenes::shipped()) {
    if (!scene.recommended) continue;
    const bool starts = scene.settings == scene.recommended->settings;
    if (scene.group == "exact" || scene.group == "playground") {
      if (!starts) own.insert(scene.name);
    } else {
      EXPECT_FALSE(starts) << scene.name;
    }
  }
  EXPECT_EQ(own,
            (std::set<std::string>{"card_house", "convoy", "newtons_cradle", "wrecking_ball"}));
}

}  // namespace
}  // namespace substep
