// Adaptive sub-stepping where the load changes during a run, compared with the smallest constant N
// that is as accurate (joint gap at most 5 % larger), which is known only after trying. With the
// scene's own settings: alpha 0.25, N decided per sub-step.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

Body& load(Scene& scene, const char* name) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return body.name == name; });
}

Outcome with_constant(const Scene& scene, int n) {
  Settings settings = scene.settings;
  settings.mode = Mode::kConst;
  settings.n = n;
  return run(scene, settings, scene.criteria.duration);
}

/// @param n the smallest constant N that is as accurate
void expect_cheaper(const Scene& scene, int n, double ratio) {
  const Outcome adaptive = run(scene, scene.settings, scene.criteria.duration);
  ASSERT_TRUE(adaptive.holds) << adaptive.verdict;
  const double enough = 1.05 * adaptive.joint_gap;
  const Outcome constant = with_constant(scene, n);
  EXPECT_TRUE(constant.holds && constant.joint_gap <= enough) << constant.joint_gap;
  for (const int fewer : {n - 1, n - 2, n - 4}) {
    const Outcome less = with_constant(scene, fewer);
    EXPECT_TRUE(!less.holds || less.joint_gap > enough) << fewer << ": " << less.joint_gap;
  }
  const double mean =
      static_cast<double>(adaptive.substeps()) / static_cast<double>(adaptive.n.size());
  EXPECT_NEAR(n / mean, ratio, 0.01 * ratio);
}

TEST(Convoy, TheBestConstantNTakesSixTenthsMore) { expect_cheaper(scenes::convoy(), 13, 1.60); }

TEST(Convoy, InTheReverseOrder) {
  Scene scene = scenes::convoy();
  std::swap(load(scene, "light").position.x(), load(scene, "heavy").position.x());
  expect_cheaper(scene, 12, 1.39);
}

// The bridge tilts and twists.
TEST(Convoy, BesideTheMiddle) {
  Scene scene = scenes::convoy();
  load(scene, "light").position.z() = 0.4;
  load(scene, "middle").position.z() = -0.3;
  load(scene, "heavy").position.z() = 0.35;
  expect_cheaper(scene, 12, 1.50);
}

TEST(Convoy, HalfAsFastAgain) {
  Scene scene = scenes::convoy();
  for (const char* name : {"light", "middle", "heavy"}) {
    load(scene, name).velocity *= 1.5;
    load(scene, name).angular_velocity *= 1.5;
  }
  expect_cheaper(scene, 18, 2.61);
}

}  // namespace
}  // namespace substep::test
