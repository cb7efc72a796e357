// The resolution of a moving picture, and the positions of the controls.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "app/render/quality.hpp"
#include "core/model/names.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

constexpr double kQuick = 1.0 / 60;  // [s]
constexpr double kSlow = 0.08;       // [s]

void observe(QualityGovernor& governor, double dt, double seconds, double own = 0.002) {
  for (double t = 0.0; t < seconds; t += dt) governor.observe(dt, own);
}

// Simulates a machine with a given drawing time at each quality [s].
// @return the number of quality changes
int simulate(QualityGovernor& governor, double coarse, double plain, double fine, double seconds) {
  int changes = 0;
  for (double t = 0.0; t < seconds;) {
    const Quality before = governor.quality();
    const double dt = before <= Quality::kCoarse  ? coarse
                      : before == Quality::kPlain ? plain
                                                  : fine;
    governor.observe(dt, 0.002);
    t += dt;
    if (governor.quality() != before) ++changes;
  }
  return changes;
}

TEST(Quality, StaysFineWhereFramesAreQuick) {
  QualityGovernor governor;
  observe(governor, kQuick, 60.0);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

TEST(Quality, GoesDownStepByStepWhereDrawingIsSlow) {
  QualityGovernor governor;
  observe(governor, kSlow, 0.7);
  EXPECT_EQ(governor.quality(), Quality::kPlain);
  observe(governor, kSlow, 0.7);
  EXPECT_EQ(governor.quality(), Quality::kCoarse);
  observe(governor, kSlow, 10.0);
  EXPECT_EQ(governor.quality(), Quality::kSketch);
}

TEST(Quality, RisesFromACoarseStartWhereFramesAreQuick) {
  QualityGovernor governor(Quality::kSketch);
  observe(governor, kQuick, 1.0);
  EXPECT_EQ(governor.quality(), Quality::kSketch);
  observe(governor, kQuick, 60.0);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

// Otherwise a page without a graphics processor would start with two seconds at five frames a
// second.
TEST(Quality, FourVerySlowFramesAreEnough) {
  QualityGovernor governor;
  observe(governor, 0.2, 0.5);
  EXPECT_EQ(governor.quality(), Quality::kFine);
  observe(governor, 0.2, 0.2);
  EXPECT_EQ(governor.quality(), Quality::kPlain);
}

// At its start a page compiles shaders and uploads textures to the graphics processor.
TEST(Quality, AStutterAtTheStartIsIgnored) {
  QualityGovernor governor;
  observe(governor, 0.5, 1.5);
  observe(governor, kQuick, 60.0);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

TEST(Quality, StaysFineWhereSimulatingIsSlow) {
  QualityGovernor governor;
  observe(governor, kSlow, 10.0, kSlow - 0.01);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

TEST(Quality, ComesBackWhenFramesAreQuickAgain) {
  QualityGovernor governor;
  observe(governor, kSlow, 3.0);
  ASSERT_EQ(governor.quality(), Quality::kSketch);
  observe(governor, kQuick, 120.0);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

TEST(Quality, SettlesWhereOnlyACoarserPictureIsQuick) {
  QualityGovernor governor;
  simulate(governor, kQuick, kQuick, kSlow, 60.0);
  // Attempts at a finer picture become rare.
  EXPECT_LE(simulate(governor, kQuick, kQuick, kSlow, 600.0), 10);
}

TEST(Quality, ManyBodiesAreDrawnCoarselyByAProcessor) {
  EXPECT_TRUE(is_software("ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (LLVM 10.0.0)))"));
  EXPECT_TRUE(is_software("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_FALSE(is_software("Mesa Intel(R) Iris(R) Xe Graphics (TGL GT2)"));
  EXPECT_FALSE(is_software(""));
  EXPECT_EQ(finest_in_software(100), Quality::kFine);
  EXPECT_EQ(finest_in_software(10000), Quality::kSketch);
}

TEST(Quality, ASuspendedTabIsIgnored) {
  QualityGovernor governor;
  for (int i = 0; i < 100; ++i) governor.observe(60.0, 0.0);
  EXPECT_EQ(governor.quality(), Quality::kFine);
}

TEST(Handles, ControlsAreFoundByNameAtAnyScale) {
  Headless h;
  for (const double scale : {1.0, 1.3}) {
    h.app->desk.scale = scale;
    h.frames(3);
    for (const char* mode : {"none", "damping", "adaptive"}) {
      h.press(mode);
      EXPECT_EQ(name_of(h.app->session.settings().mode), std::string_view(mode));
    }
  }
}

TEST(Handles, HiddenControlHasNone) {
  Headless h;
  ASSERT_NE(find_handle("adaptive"), nullptr);
  h.app->desk.panels = false;
  h.frames(3);
  EXPECT_EQ(find_handle("adaptive"), nullptr);
}

}  // namespace
}  // namespace substep
