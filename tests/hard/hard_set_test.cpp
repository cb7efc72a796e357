// The recommended setting on scenes far past the paper's. The whole set, with its work, is in
// scenes/README.md and comes from `substep check --hard`; here are the ones that are cheap to run.

#include "scenes/generator/hard_set.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/presets.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

const Settings& recommended() { return find_preset("recommended")->settings; }

TEST(HardSet, EveryCaseIsASceneThatTheLoaderTakes) {
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

TEST(HardSet, TheRecommendedSettingHoldsAllJointedCasesButSlackChains) {
  int cases = 0;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    // Those without contact, small enough for seconds.
    if (hard.scene.effects.contact || hard.scene.bodies.size() > 60) continue;
    ++cases;
    const Outcome r = run(hard.scene, recommended(), hard.scene.criteria.duration);
    // A chain that snaps taut pulls for one sub-step, which the K of the sub-step before does not
    // foretell.
    EXPECT_EQ(r.holds, hard.family != "slack chains") << hard.scene.name << ": " << r.verdict;
    EXPECT_LE(r.n_max(), recommended().n_cap) << hard.scene.name;
  }
  EXPECT_GT(cases, 20);
}

// Implicit at the end of the sub-step: it needs no K that foretells, and slack chains hold too.
TEST(HardSet, TheRobustSettingHoldsAllJointedCases) {
  const Settings& robust = find_preset("robust")->settings;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    if (hard.scene.bodies.size() > 60) continue;
    if (hard.scene.effects.contact && hard.family != "impacts") continue;
    const Outcome r = run(hard.scene, robust, hard.scene.criteria.duration);
    EXPECT_TRUE(r.holds) << hard.scene.name << ": " << r.verdict;
  }
}

TEST(HardSet, AStepAFrameHoldsHardlyAnyChain) {
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
