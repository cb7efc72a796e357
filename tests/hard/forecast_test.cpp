// The forecast of N before a scene moves.

#include "core/lab/forecast.hpp"

#include <gtest/gtest.h>

#include "scenes/generator/hard_set.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

TEST(Forecast, AtTheStartIsTheNOfTheFirstFrame) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::bridge(), scenes::heavy_stack()}) {
    Simulator simulator(std::make_shared<const Scene>(scene));
    const FrameReport report = simulator.step();
    EXPECT_EQ(forecast(scene, scene.settings).at_start, report.n_wanted) << scene.name;
  }
}

TEST(Forecast, OfAChainThatHangsStillIsItsN) {
  for (const double mass : {10.0, 1000.0, 1e5}) {
    const Scene scene = scenes::rope_of_n({.end_mass = mass, .angle = {0.0, 1.0}});
    const Settings settings{.n_max = 10000};
    const Outcome hanging = run(scene, settings, 0.5);
    const Forecast predicted = forecast(scene, settings);
    // The uppermost link carries 25 kg more than the lowest; Eq. 11 rounds up.
    EXPECT_NEAR(predicted.hanging, hanging.n_median(), 1.0 + 0.02 * predicted.hanging) << mass;
    EXPECT_EQ(predicted.mass_ratio, mass);
  }
}

TEST(Forecast, OfASwingIsWithinSqrtThreeOfItsMaximum) {
  const Scene scene = scenes::swinging_box();
  const int predicted = forecast(scene, scene.settings).hanging;
  const Outcome swing = run(scene, scene.settings, 10.0);
  EXPECT_GT(swing.n_max(), predicted);
  EXPECT_LE(swing.n_max(), 1.7320508 * predicted + 1.0);
}

TEST(Forecast, ScalesWithTheSquareRootOfLoadOverAlpha) {
  const auto predicted = [](double mass, double alpha) {
    return forecast(scenes::rope_of_n({.end_mass = mass}), {.alpha = alpha}).hanging;
  };
  EXPECT_NEAR(predicted(4e6, 0.1), 2 * predicted(1e6, 0.1), 2);
  EXPECT_NEAR(predicted(1e6, 0.025), 2 * predicted(1e6, 0.1), 2);
}

TEST(Forecast, OfALoopSharesTheLoadBetweenItsTwoSides) {
  // Both ends of the bridge hold half of the planks: far less than the ball, that no joint holds.
  const Forecast bridge = forecast(scenes::bridge(), {});
  EXPECT_GE(bridge.body, 1);
  EXPECT_LT(bridge.hanging, bridge.at_start);
}

TEST(Forecast, ExistsForEveryHardCase) {
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    const Forecast predicted = forecast(hard.scene, hard.scene.settings);
    EXPECT_GE(predicted.n(), 1) << hard.scene.name;
    EXPECT_GE(predicted.mass_ratio, 1.0) << hard.scene.name;
  }
}

}  // namespace
}  // namespace substep::test
