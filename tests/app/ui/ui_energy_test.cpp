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
double rounding(double a, double b, double c, double d = 0.0) {
  return 2.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
         (std::abs(a) + std::abs(b) + std::abs(c) + std::abs(d));
}

// Every sample of the curves adds up to the total.
void expect_sums(const Headless& h, const Session& session) {
  const History& history = session.history();
  const bool gravity = session.loaded().effects.gravity;
  const auto curves = ui::energy_series(*h.app->look.theme, history, gravity);
  const ui::Series* kinetic = curve(curves, Channel::kKinetic);
  const ui::Series* potential = curve(curves, Channel::kPotential);
  const ui::Series* elastic = curve(curves, Channel::kElastic);
  const ui::Series* total = curve(curves, Channel::kTotal);
  const std::string& name = session.scene().name;
  ASSERT_NE(kinetic, nullptr);
  ASSERT_EQ(potential != nullptr, gravity) << name;
  ASSERT_EQ(elastic != nullptr, history.has_springs()) << name;
  ASSERT_EQ(total != nullptr, gravity || history.has_springs()) << name;
  if (total == nullptr) return;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double k = plotted(*kinetic, i);
    const double p = potential != nullptr ? plotted(*potential, i) : 0.0;
    const double e = elastic != nullptr ? plotted(*elastic, i) : 0.0;
    const double sum = plotted(*total, i);
    ASSERT_NEAR(k + p + e, sum, rounding(k, p - total->offset, e, sum - total->offset))
        << name << ", " << i;
  }
}

TEST(EnergyPlot, ItsPartsMakeTheTotalInEverySampleOfEveryScene) {
  Headless h;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    for (int i = 0; i < kFrames; ++i) h.app->session.step();
    ASSERT_GT(h.app->session.history().size(), 0U) << scene->name;
    expect_sums(h, h.app->session);
  }
}

TEST(EnergyPlot, SpringsAreInTheSum) {
  Headless h;
  Scene scene = *shipped("pendulum");
  base(scene.joints.front()).compliance = 1e-3;  // the hinge is a spring of 1 kN/m
  h.app->run(std::make_shared<const Scene>(scene));
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < kFrames; ++i) session.step();
  ASSERT_TRUE(session.history().has_springs());
  expect_sums(h, session);
  const double most = static_cast<double>(
      session.history().samples(Channel::kElastic).extent(0, session.history().size()).high);
  EXPECT_GT(most, 0.04) << "J: the weight of 1 kg alone stores (m g)^2 / 2 k = 0.048 J";
}

TEST(EnergyPlot, ItsZeroIsOfTheSceneAndStays) {
  Headless h;
  Session& session = h.app->session;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    const double zero = session.history().potential_offset();
    EXPECT_EQ(zero, scene->criteria.energy_scale.value_or(0.0)) << scene->name;
    for (int i = 0; i < kFrames; ++i) {
      session.step();
      ASSERT_EQ(session.history().potential_offset(), zero) << scene->name;
    }
  }
}

Ball heavy_ball() { return {Vec3(0.0, 9.0, 2.0), Vec3(3.0, 1.0, -12.0), 0.3, 60.0}; }

double last(const Session& session, Channel channel) {
  return static_cast<double>(session.history()[channel].back());
}

// The energy of a ball that flies free, with the potential's zero at the origin.
double energy_of(const Scene& scene, const Ball& ball) {
  return 0.5 * ball.mass * ball.velocity.squaredNorm() -
         ball.mass * scene.gravity.dot(ball.position);
}

TEST(EnergyAccount, ABallIsTheUsersWorkAndNoDrift) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 30; ++i) session.step();
  const double before = session.report().energy;
  const double drift = last(session, Channel::kDrift);
  EXPECT_EQ(session.account().put_in(), 0.0);
  session.throw_ball(heavy_ball());
  const double work = session.account().put_in();
  EXPECT_NEAR(work, energy_of(session.scene(), heavy_ball()), 1e-12 * std::abs(before));
  // Far from the chain, the ball changes nothing of what the method does.
  session.step();
  EXPECT_LT(std::abs(last(session, Channel::kDrift) - drift), 1e-3 * work);
  EXPECT_EQ(session.account().put_in(), work);
  expect_sums(h, session);
  session.reset();
  EXPECT_EQ(session.account().put_in(), 0.0);
}

TEST(EnergyAccount, APullIsBookedFrameByFrameAndReleasedWithTheHand) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 10; ++i) session.step();
  const double drift = last(session, Channel::kDrift);
  const double start = session.report().energy - session.account().put_in();
  const Vec3 target = session.state().x[3] + Vec3(0.0, 0.5, 0.5);
  session.grab(3, Vec3::Zero(), target);
  for (int i = 0; i < 20; ++i) {
    const double before = session.report().energy;
    const double booked = session.account().put_in();
    session.step();
    const double change = session.report().energy - before;
    ASSERT_NEAR(session.account().put_in() - booked, change, 1e-12 * std::abs(before)) << i;
  }
  EXPECT_NEAR(session.report().energy - session.account().put_in(), start, 1e-10 * std::abs(start));
  EXPECT_NEAR(last(session, Channel::kDrift), drift, 1e-6 * std::abs(start));
  session.let_go();
  const double booked = session.account().put_in();
  for (int i = 0; i < 5; ++i) session.step();
  EXPECT_EQ(session.account().put_in(), booked) << "the hand is gone";
  expect_sums(h, session);
  // Also when the hand lets go between two sub-steps of a frame.
  ASSERT_EQ(h.app->set("mode", "const"), "");
  ASSERT_EQ(h.app->set("n", "8"), "");
  session.grab(3, Vec3::Zero(), target);
  const double before = session.report().energy;
  session.substep();
  ASSERT_GT(session.substeps_left(), 0);
  session.let_go();
  while (session.substeps_left() > 0) session.substep();
  EXPECT_NEAR(session.account().put_in() - booked, session.report().energy - before,
              1e-12 * std::abs(before));
}

TEST(EnergyAccount, ThePastHasItsOwnAndComparedRunsToo) {
  Headless h;
  h.app->open_link("scene=swinging_box&mode=adaptive&compare=mode:adaptive");
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 20; ++i) session.step();
  session.throw_ball(heavy_ball());
  for (int i = 0; i < 10; ++i) session.step();
  const double work = session.account().put_in();
  ASSERT_NE(work, 0.0);
  h.frames(2);
  const Compare::Run& same = h.app->compare.runs().front();
  EXPECT_EQ(same.account.put_in(), work);
  EXPECT_EQ(same.history[Channel::kDrift].back(), session.history()[Channel::kDrift].back());
  session.go_to(10);
  EXPECT_EQ(session.account().put_in(), 0.0);
  session.go_to(25);
  EXPECT_EQ(session.account().put_in(), work);
  h.frames(2);
  EXPECT_EQ(same.account.put_in(), work);
}

TEST(EnergyAccount, GravitySwitchedOffIsAnEditOfTheScene) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 20; ++i) session.step();
  const double potential = session.report().potential;
  Effects effects = session.scene().effects;
  effects.gravity = false;
  session.set_effects(effects);
  EXPECT_NEAR(session.account().put_in(), -potential, 1e-12 * std::abs(potential));
  for (int i = 0; i < 5; ++i) session.step();
  expect_sums(h, session);
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
  EXPECT_EQ(energy_change(-22.8e-9, 0.162), "−22.8 nJ (< 0.001 %)");
}

}  // namespace
}  // namespace substep
