// Impacts of bodies whose contacts are found along the motion (detection continuous): bodies that
// tumble, that touch others or are held, friction and restitution, with preset `steady`.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/model/scene_builder.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr double kRadius = 0.1;  // of a ball [m]

// The struck ball moves for the rest of the sub-step only, and does not reach the next one in it.
TEST(SweptImpacts, BallsWithSmallGapsPassAnImpactOn) {
  const double speeds[] = {0.0, 0.0, 1.24};
  for (const double gap : {0.3e-3, 1e-3, 3e-3}) {
    for (const double away : {0.300, 0.306, 0.312, 0.318}) {  // they meet at any time of a frame
      SceneBuilder builder("gaps");
      for (int i = 0; i < 3; ++i) {
        const double before = i == 0 ? away : 0.0;
        const Vec3 place{i * (2.0 * kRadius + gap) - before, 0.0, 0.0};
        builder.body(builder.add_body(Sphere{kRadius}, 1.0, place)).restitution = 1.0;
      }
      builder.body(0).velocity = {speeds[2], 0.0, 0.0};
      builder.scene().gravity = Vec3::Zero();
      const Scene scene = *builder.build();
      for (const int n : {0, 1, 4}) {
        SCOPED_TRACE(std::to_string(gap) + " from " + std::to_string(away) + " n " +
                     std::to_string(n));
        const Outcome outcome = run(scene, steady_at(n), 1.0);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(outcome.end.u_synchronised[i].x(), speeds[i], 1e-4) << i;
        }
      }
    }
  }
}

// A plate on a slide, or on the floor, does not fall with the ball.
TEST(SweptImpacts, ABallReboundsFromWhatIsHeld) {
  for (const bool slides : {true, false}) {
    SCOPED_TRACE(slides);
    constexpr double kHeight = 0.4;
    SceneBuilder builder("plate");
    if (!slides) builder.add_fixed(Plane{}, {0.0, -0.1, 0.0});
    const int plate =
        builder.add_body(Box{{0.5, 0.05, 0.5}}, slides ? 5.0 : 1000.0, {0.0, -0.05, 0.0});
    if (slides) builder.add_prismatic(plate, kWorld, {0.0, -0.05, 0.0}, Vec3::UnitX());
    const int ball = builder.add_body(Sphere{kRadius}, 1.0, {0.0, kHeight + kRadius, 0.0});
    builder.body(ball).restitution = 1.0;
    double last = 0.0;
    double before = 0.0;
    std::vector<double> apexes;
    const EveryFrame every = [&](const Simulator& simulator, const FrameReport&) {
      const double height = simulator.state().x[index(ball)].y() - kRadius;
      if (last > before && last >= height) apexes.push_back(last);
      before = std::exchange(last, height);
    };
    run(*builder.build(), steady(), 2.5, every, false);
    ASSERT_GE(apexes.size(), 3U);
    for (const double apex : apexes) EXPECT_NEAR(apex, kHeight, 0.05 * kHeight);
  }
}

// A domino that leans on another reported the speed of half a sub-step of fall.
TEST(SweptImpacts, RestingBodiesReportNoFall) {
  for (const double frame : {1.0 / 30.0, 1.0 / 60.0}) {
    SceneBuilder builder("dominoes");
    builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = 0.4;
    const Vec3 half{0.005, 0.05, 0.025};
    for (int i = 0; i < 6; ++i) {
      const int domino = builder.add_body(Box{half}, 0.1, {0.03 * i, half.y(), 0.0});
      Body& body = builder.body(domino);
      body.friction = 0.4;
      if (i > 0) continue;
      constexpr double kLean = 0.12;
      body.orientation = Quat{Eigen::AngleAxisd(-kLean, Vec3::UnitZ())};
      body.position = Vec3{half.x(), 0.0, 0.0} + body.orientation * Vec3{-half.x(), half.y(), 0.0};
    }
    builder.scene().frame = frame;
    EXPECT_EQ(run(*builder.build(), steady(), 2.0).verdict, "holds") << frame;
  }
}

/// A box of unequal moments that tumbles fast onto a floor, or pairs that hit each other in space.
Scene tumbling(unsigned seed, double e, double friction, bool in_space, int pairs = 1) {
  std::mt19937_64 random(seed);
  const auto number = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  SceneBuilder builder("tumbling");
  builder.scene().gravity = in_space ? Vec3(Vec3::Zero()) : Vec3(0.0, -kGravity, 0.0);
  if (!in_space) builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = friction;
  for (int box_index = 0; box_index < (in_space ? 2 * pairs : 1); ++box_index) {
    const int i = box_index % 2;
    const double apart = 10.0 * (box_index / 2);
    const Vec3 half{0.3, number(0.03, 0.3), number(0.03, 0.3)};
    const int box =
        builder.add_body(Box{half}, number(0.5, 2.0), {1.2 * i, in_space ? 0.0 : 1.0, apart});
    Body& body = builder.body(box);
    body.orientation =
        Quat{number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)}.normalized();
    body.velocity =
        in_space ? Vec3(i == 0 ? 3.0 : -3.0, 0.0, 0.0) : Vec3(number(-5, 5), -2.0, number(-5, 5));
    body.angular_velocity = {number(-20, 20), number(-20, 20), number(-20, 20)};
    body.friction = friction;
    body.restitution = e;
  }
  return *builder.build();
}

TEST(SweptImpacts, TumblingBoxesKeepTheirEnergyInElasticImpacts) {
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    for (const bool in_space : {false, true}) {
      int impacts = 0;
      for (unsigned seed = 0; seed < 10; ++seed) {
        const Scene scene = tumbling(seed, 1.0, 0.0, in_space);
        for (const int n : {0, 8, 64}) {  // 0: adaptive
          SCOPED_TRACE(std::to_string(seed) + " n " + std::to_string(n));
          Settings settings = steady_at(n);
          settings.integrator = integrator;
          double energy = 0.0;
          const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
            if (report.frame == 1) energy = report.energy;
            impacts += static_cast<int>(report.work.impacts);
            EXPECT_EQ(report.lowered, 0);
            EXPECT_NEAR(report.energy, energy, 1e-3 * energy);
          };
          run(scene, settings, 3.0, every, false);
        }
      }
      EXPECT_GT(impacts, in_space ? 20 : 100);
    }
  }
}

// More impacts in a frame than may end a sub-step: most happen within one.
TEST(SweptImpacts, ManyImpactsInAFrameKeepTheEnergy) {
  const Scene scene = tumbling(3, 1.0, 0.0, true, 60);
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    for (const int n : {0, 8}) {  // 0: adaptive
      SCOPED_TRACE(n);
      Settings settings = steady_at(n);
      settings.integrator = integrator;
      double energy = 0.0;
      std::int64_t impacts = 0;
      std::int64_t most = 0;  // in a frame
      const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
        if (report.frame == 1) energy = report.energy;
        impacts += report.work.impacts;
        most = std::max(most, std::int64_t{report.work.impacts});
        EXPECT_NEAR(report.energy, energy, 1e-3 * energy);
      };
      run(scene, settings, 0.3, every, false);
      EXPECT_GT(impacts, 40);
      EXPECT_GT(most, 12);
    }
  }
}

// Newton's law with friction adds energy (Kane and Levinson 1985).
TEST(SweptImpacts, RestitutionIsLoweredWhereItWouldAddEnergy) {
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    int lowered = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      for (const double e : {0.5, 0.9, 1.0}) {
        SCOPED_TRACE(std::to_string(seed) + " e " + std::to_string(e));
        Settings settings = steady();
        settings.solver = solver;
        double energy = std::numeric_limits<double>::infinity();
        double kinetic = 0.0;
        const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
          keep_largest(kinetic, report.kinetic);
          EXPECT_LT(report.energy, energy + 0.01 * kinetic);
          energy = std::min(energy, report.energy);
          lowered += report.lowered;
          EXPECT_EQ(report.lowered > 0, report.lowered_to < 1.0);
          EXPECT_GE(report.lowered_to, 0.0);
        };
        run(tumbling(seed, e, 1.0, false), settings, 3.0, every, false);
      }
    }
    EXPECT_GT(lowered, 20);
  }
}

TEST(SweptImpacts, ARowOfBallsPassesAnImpactOn) {
  SceneBuilder builder("row");
  for (int i = 0; i < 5; ++i) {
    const int ball =
        builder.add_body(Sphere{kRadius}, 1.0, {i == 0 ? -1.0 : 2.0 * kRadius * i, 0.0, 0.0});
    builder.body(ball).restitution = 1.0;
  }
  builder.body(0).velocity = {5.0, 0.0, 0.0};
  builder.scene().gravity.setZero();
  for (const int n : {1, 4, 64, 600}) {
    SCOPED_TRACE(n);
    Simulator simulator = simulator_of(builder.build(), steady_at(n));
    for (int i = 0; i < 30; ++i) simulator.step();
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(simulator.state().u[i].x(), i == 4 ? 5.0 : 0.0, 5e-3) << i;
    }
    // No time is lost on the way of 1 m to the row and from there on.
    EXPECT_NEAR(simulator.state().x[4].x(), 8.0 * kRadius + 5.0 * (0.5 - 1.0 / 5.0), 1e-3);
  }
}

// The wrecking ball hits the crates at 1 s; balls bounce from 0.6 s on.

}  // namespace
}  // namespace substep::test
