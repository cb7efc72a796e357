// The energy plots add up, and no percentage is relative to zero.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/ui/plot_curves.hpp"
#include "app/ui/plots.hpp"
#include "core/lab/energy_scale.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

constexpr int kFrames = 90;  // enough for some to fall, swing or collide

// The value of a curve of the plot at a sample.
double plotted(const ui::Series& series, std::size_t i) {
  return static_cast<double>((*series.history)[series.channel][i]) + series.offset;
}

const ui::Series* curve(const std::vector<ui::Series>& all, Channel channel) {
  for (const ui::Series& one : all) {
    if (one.channel == channel) return &one;
  }
  return nullptr;
}

// Samples are rounded to single precision, each by half a unit in the last place.
double rounding(double a, double b, double c) {
  return 2.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
         (std::abs(a) + std::abs(b) + std::abs(c));
}

TEST(EnergyPlot, KineticAndPotentialMakeTheTotalInEverySampleOfEveryScene) {
  Headless h;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    for (int i = 0; i < kFrames; ++i) h.app->session.step();
    const History& history = h.app->session.history();
    ASSERT_GT(history.size(), 0U) << scene->name;
    const auto curves = ui::energy_series(*h.app->look.theme, history, scene->effects.gravity);
    const ui::Series* kinetic = curve(curves, Channel::kKinetic);
    const ui::Series* potential = curve(curves, Channel::kPotential);
    const ui::Series* total = curve(curves, Channel::kTotal);
    ASSERT_NE(kinetic, nullptr);
    ASSERT_EQ(potential != nullptr, scene->effects.gravity) << scene->name;
    ASSERT_EQ(total != nullptr, scene->effects.gravity) << scene->name;
    if (total == nullptr) continue;
    for (std::size_t i = 0; i < history.size(); ++i) {
      const double k = plotted(*kinetic, i);
      const double p = plotted(*potential, i);
      const double sum = plotted(*total, i);
      ASSERT_NEAR(k + p, sum, rounding(k, p - potential->offset, sum)) << scene->name << ", " << i;
      ASSERT_GE(p, 0.0) << scene->name << ": none is negative";
    }
  }
}

TEST(EnergyPlot, TheTotalIsTheReportedEnergyUpToTheZeroOfThePotential) {
  Headless h;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    const double start = h.app->session.report().energy;
    for (int i = 0; i < kFrames; ++i) h.app->session.step();
    const History& history = h.app->session.history();
    const FrameReport& report = h.app->session.report();
    const double total =
        static_cast<double>(history[Channel::kTotal].back()) + history.potential_at_start();
    EXPECT_NEAR(total, report.energy, rounding(report.kinetic, report.potential, start) + 1e-9)
        << scene->name;
    // The drift keeps digits that the total loses.
    const double drift = report.energy - start;
    EXPECT_NEAR(static_cast<double>(history[Channel::kDrift].back()), drift,
                1e-7 * std::abs(drift) + 1e-12)
        << scene->name;
  }
}

TEST(EnergyPlot, AnOffsetMovesTheExtent) {
  Extent extent;
  EXPECT_TRUE(ui::shifted(extent, 3.0).empty());
  extent.add(-2.0F);
  extent.add(5.0F);
  EXPECT_EQ(ui::shifted(extent, 3.0).low, 1.0F);
  EXPECT_EQ(ui::shifted(extent, 3.0).high, 8.0F);
}

TEST(EnergyDrift, ACardHouseAtRestHasNoPercentage) {
  Headless h;
  h.app->run(shipped("card_house"));
  for (int i = 0; i < kFrames; ++i) {
    h.app->session.step();
    const History& history = h.app->session.history();
    const auto scale = energy_scale(h.app->session.scene().criteria.energy_scale,
                                    history.largest_kinetic(), history.largest_drift());
    const std::string text =
        energy_change(static_cast<double>(history[Channel::kDrift].back()), scale);
    ASSERT_EQ(text.find('%'), std::string::npos) << text;
  }
}

TEST(EnergyDrift, NoSceneShowsMoreThanAHundredPerCent) {
  Headless h;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    ASSERT_EQ(h.app->set("mode", "none"), "");  // failing runs are included
    for (int i = 0; i < kFrames; ++i) {
      h.app->session.step();
      const History& history = h.app->session.history();
      if (history.size() == 0) continue;
      const auto scale = energy_scale(scene->criteria.energy_scale, history.largest_kinetic(),
                                      history.largest_drift());
      const auto drift = static_cast<double>(history[Channel::kDrift].back());
      if (const auto share = energy_share(drift, scale)) {
        ASSERT_LE(std::abs(*share), 1.0) << scene->name;
        ASSERT_GE(*scale, kLeastEnergyScale) << scene->name;
      }
    }
  }
}

TEST(EnergyDrift, PercentagesAreOfASignificantEnergy) {
  // 1 mJ in a card house at rest: its kinetic energy is noise.
  EXPECT_EQ(energy_change(-1e-3, energy_scale(std::nullopt, 2e-5, 1e-3)), "−1.00 mJ");
  // A kinetic energy hardly larger than the drift is itself drift.
  EXPECT_EQ(energy_change(3.0, energy_scale(std::nullopt, 20.0, 3.0)), "+3.00 J");
  EXPECT_EQ(energy_change(3.0, energy_scale(std::nullopt, 300.0, 3.0)), "+3.00 J (+1.00 %)");
  // The exchanged energy that the scene states is used until more than that is lost.
  EXPECT_EQ(energy_change(-10.3e3, energy_scale(51.5e3, 0.0, 10.3e3)), "−10.3 kJ (−20.0 %)");
  EXPECT_EQ(energy_change(1e6, energy_scale(51.5e3, 0.0, 1e6)), "+1.00 MJ");
  EXPECT_EQ(energy_change(1e-9, energy_scale(1e-6, 0.0, 0.0)), "+1.00 nJ");
  EXPECT_FALSE(energy_scale(std::nullopt, std::numeric_limits<double>::infinity(), 0.0));
  EXPECT_FALSE(energy_scale(std::nullopt, 1.0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(energy_change(0.0, 1.0), "0 J (0 %)");
}

}  // namespace
}  // namespace substep
