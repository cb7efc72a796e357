// The recommended setting on scenes far beyond the paper's. The whole set, with its work, is in
// scenes/hard_set.md and printed by `substep check --hard`; these are the cheap ones.

#include "scenes/generator/hard_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/presets.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Settings recommended() { return find_preset("recommended")->settings; }

TEST(HardSet, EveryCaseIsAValidScene) {
  std::set<std::string> names;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    EXPECT_TRUE(names.insert(hard.scene.name).second) << hard.scene.name;
    const SceneResult read = read_scene(write_scene(hard.scene));
    for (const Problem& problem : read.problems) {
      ADD_FAILURE() << hard.scene.name << ": " << to_string(problem);
    }
  }
  EXPECT_GT(names.size(), 45U);
}

TEST(HardSet, TheRecommendedSettingHoldsAllJointedCasesButTheLongSlackChain) {
  int cases = 0;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    // Those without contact that take only seconds.
    if (hard.scene.effects.contact || hard.scene.bodies.size() > 60) continue;
    ++cases;
    const Outcome r = run(hard.scene, recommended(), hard.scene.criteria.duration);
    // A chain that snaps taut pulls for one sub-step, which the K of the previous sub-step does not
    // predict.
    EXPECT_EQ(r.holds, hard.scene.name != "slack_of_24") << hard.scene.name << ": " << r.verdict;
    EXPECT_LE(r.n_max(), recommended().n_cap) << hard.scene.name;
  }
  EXPECT_GT(cases, 20);
}

// Implicit at the end of the sub-step: it does not need K to predict the force, and slack chains
// hold too.
TEST(HardSet, TheRobustSettingHoldsAllJointedCases) {
  const Settings& robust = find_preset("robust")->settings;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    if (hard.scene.bodies.size() > 60) continue;
    if (hard.scene.effects.contact && hard.family != "impacts") continue;
    const Outcome r = run(hard.scene, robust, hard.scene.criteria.duration);
    EXPECT_TRUE(r.holds) << hard.scene.name << ": " << r.verdict;
  }
}

// A chain that starts near the horizontal becomes slack on its way up and snaps taut, which the K
// of the previous sub-step does not predict. These settings hold it for a minute at a bounded cost;
// the paper's setting holds most of the starts for only some seconds (they gain a tenth of the
// energy of the start at 60 degrees and more).
TEST(SlackStarts, HoldAMinuteWithBoundedN) {
  Settings soft;
  soft.drift = Drift::kSoft;
  Settings by_substep;
  by_substep.policy = Policy::kSubstep;
  struct Row {
    const char* name;
    Settings settings;
    int most;
  };
  const Row rows[] = {{"recommended", recommended(), 4},
                      {"robust", find_preset("robust")->settings, 4},
                      {"soft drift", soft, 64},
                      {"by sub-step", by_substep, 64}};
  int paper = 0;
  for (const double degrees : {85.0, 88.0, 89.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Scene scene =
        scenes::swinging_box({.angle = {std::sin(angle), std::cos(angle)}, .compliance = 1e-12});
    for (const auto& [name, settings, most] : rows) {
      const Outcome r = run(scene, settings, 60.0);
      EXPECT_TRUE(r.holds) << name << " at " << degrees << ": " << r.verdict;
      EXPECT_LE(r.n_max(), most) << name << " at " << degrees;
    }
    paper += run(scene, Settings{}, 20.0).holds ? 1 : 0;
  }
  EXPECT_LE(paper, 1);
}

TEST(HardSet, OneStepPerFrameHoldsHardlyAnyChain) {
  const Settings none{.mode = Mode::kNone};
  int held = 0;
  int cases = 0;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    if (hard.scene.effects.contact || hard.scene.bodies.size() > 60) continue;
    ++cases;
    held += run(hard.scene, none, hard.scene.criteria.duration).holds ? 1 : 0;
  }
  EXPECT_LT(4 * held, cases) << "the set is not hard";
}

}  // namespace
}  // namespace substep::test
