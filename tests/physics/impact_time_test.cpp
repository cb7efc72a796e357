// Impacts of bodies on joints, and impacts without rebound: they act at the poses and at the time
// at which bodies meet. Preset `steady`.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/model/scene_builder.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr int kSubstepCounts[] = {0, 1, 2, 4, 16};  // 0: adaptive

/// Rods on joints that swing against a wall and a floor. e = 1, no friction.
Scene swinging_rods(int rods, bool in_space) {
  SceneBuilder builder("rods");
  const Vec3 half{0.25, 0.04, 0.03};
  const Quat start{Eigen::AngleAxisd(in_space ? 0.4 : 0.0, Vec3::UnitY())};
  int last = kWorld;
  for (int i = 0; i < rods; ++i) {
    const int rod =
        builder.add_body(Box{half}, i == 0 ? 1.0 : 0.4, start * Vec3(0.27 + 0.54 * i, 0, 0));
    builder.body(rod).orientation = start;
    builder.body(rod).restitution = 1.0;
    const Vec3 at = start * Vec3(0.54 * i, 0.0, 0.0);
    if (in_space) {
      builder.add_ball_joint(rod, last, at);
    } else {
      builder.add_hinge(rod, last, at, Vec3::UnitZ());
    }
    last = rod;
  }
  builder.add_fixed(Box{{0.1, 2.0, 2.0}}, {-0.25, -1.0, 0.0});
  builder.add_fixed(Plane{}, {0.0, -0.45 * rods - 0.2, 0.0});
  return *builder.build();
}

TEST(ImpactTime, RodsOnJointsKeepTheirEnergyInElasticImpacts) {
  for (const int rods : {1, 2, 3}) {
    for (const bool in_space : {false, true}) {
      const Scene scene = swinging_rods(rods, in_space);
      for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
        for (const int n : {0, 16}) {
          // A fourth-order method starts again after an impact, with errors of its long sub-steps.
          if (integrator == Integrator::kStormer && n == 0) continue;
          SCOPED_TRACE(std::to_string(rods) + (in_space ? " in space" : "") + " n " +
                       std::to_string(n) + " " + std::to_string(static_cast<int>(integrator)));
          Settings settings = steady_at(n);
          settings.integrator = integrator;
          double start = 0.0;
          double kinetic = 0.0;
          double least = 1e30;
          double most = -1e30;
          std::int64_t impacts = 0;
          const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
            if (report.frame == 1) start = report.energy;
            keep_largest(kinetic, report.kinetic);
            least = std::min(least, report.energy);
            keep_largest(most, report.energy);
            impacts += report.work.impacts;
          };
          run(scene, settings, 3.0, every, false);
          EXPECT_GT(impacts, 0);
          EXPECT_LT(most, start + 0.01 * kinetic);
          EXPECT_GT(least, start - 0.01 * kinetic);
        }
      }
    }
  }
}

// Housner 1963: a slender block keeps (1 - 3/2 sin^2 a)^2 of its energy when it rocks from one edge
// to the other.
TEST(ImpactTime, ARockingBlockLosesWhatHousnerSays) {
  constexpr double kSlender = 0.2;  // half width / half height
  const Vec3 half{0.1, 0.1 / kSlender, 0.1};
  const double a = std::atan(kSlender);
  const double kept = std::pow(1.0 - 1.5 * std::pow(std::sin(a), 2.0), 2.0);
  for (const int n : kSubstepCounts) {
    for (const double lean : {0.5, 0.6, 0.7}) {
      SCOPED_TRACE(std::to_string(n) + " lean " + std::to_string(lean));
      SceneBuilder builder("block");
      builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = 5.0;
      const int block = builder.add_body(Box{half}, 1.0, Vec3::Zero());
      Body& body = builder.body(block);
      body.friction = 5.0;
      body.orientation = Quat{Eigen::AngleAxisd(lean * a, Vec3::UnitZ())};
      body.position = body.orientation * Vec3{half.x(), half.y(), 0.0};
      const Scene scene = *builder.build();
      const double rest = kGravity * half.y();
      double start = 0.0;
      double after = 0.0;
      double last = 1.0;
      const EveryFrame every = [&](const Simulator& simulator, const FrameReport& report) {
        if (report.frame == 1) start = report.energy - rest;
        const double turn = 2.0 * std::asin(simulator.state().q[index(block)].z());
        if (after == 0.0 && turn < -0.1 * a && turn > last) after = report.energy - rest;
        last = turn;
      };
      run(scene, steady_at(n), 1.5, every, false);
      EXPECT_NEAR(after / start, kept, 0.02);
    }
  }
}

// In the plane, without gravity: the impulse through the corner follows from J M^-1 J^T.
TEST(ImpactTime, AnObliquePlasticImpactTurnsABoxAsItsCornerSays) {
  const Vec3 half{0.3, 0.2, 0.25};
  for (const int n : kSubstepCounts) {
    for (const double turn : {0.2, 0.5, 0.9}) {
      for (const double speed : {1.0, 5.0}) {
        SCOPED_TRACE(std::to_string(n) + " turn " + std::to_string(turn) + " speed " +
                     std::to_string(speed));
        SceneBuilder builder("corner");
        builder.scene().gravity.setZero();
        builder.add_fixed(Plane{}, Vec3::Zero());
        const int box = builder.add_body(Box{half}, 2.0, {0.0, 0.537, 0.0});
        Body& body = builder.body(box);
        body.orientation = Quat{Eigen::AngleAxisd(turn, Vec3::UnitZ())};
        body.velocity = {0.4, -speed, 0.0};
        const Scene scene = *builder.build();
        const Vec3 arm = body.orientation * Vec3{-half.x(), -half.y(), 0.0};
        const double inertia = scene.bodies[index(box)].inertia.z();
        const double impulse = speed / (0.5 + arm.x() * arm.x() / inertia);
        const double spin = arm.x() * impulse / inertia;
        double measured = 0.0;
        const EveryFrame every = [&](const Simulator& simulator, const FrameReport&) {
          const double now = simulator.state().u[index(box)][5];
          if (measured == 0.0 && now != 0.0) measured = now;
        };
        run(scene, steady_at(n), 0.3, every, false);
        EXPECT_NEAR(measured, spin, 1e-3 * std::abs(spin));
      }
    }
  }
}

// The impulse acts where the bodies meet.
TEST(ImpactTime, AnObliqueImpactKeepsTheAngularMomentum) {
  for (const double e : {0.2, 0.5, 1.0}) {
    for (const int n : kSubstepCounts) {
      SCOPED_TRACE(std::to_string(e) + " n " + std::to_string(n));
      SceneBuilder builder("oblique");
      builder.scene().gravity.setZero();
      const int a = builder.add_body(Sphere{0.1}, 1.0, {-0.713, 0.09, 0.0});
      const int b = builder.add_body(Box{{0.1, 0.2, 0.1}}, 2.0, {0.5, -0.08, 0.02});
      builder.body(a).velocity = {10.0, 0.0, 0.0};
      for (const int body : {a, b}) {
        builder.body(body).restitution = e;
        builder.body(body).friction = 0.5;
      }
      const Scene scene = *builder.build();
      const auto momentum = [&](const State& state) {
        Vec3 sum = Vec3::Zero();
        for (const int body : {a, b}) {
          const Body& of = scene.bodies[index(body)];
          const Vec6& u = state.u_synchronised[index(body)];
          const Mat3 R = state.q[index(body)].toRotationMatrix();
          sum += of.mass * state.x[index(body)].cross(Vec3(u.head<3>())) +
                 R * of.inertia.cwiseProduct(R.transpose() * Vec3(u.tail<3>()));
        }
        return sum;
      };
      const Vec3 before = momentum(simulator_of(scene, steady_at(n)).state());
      Simulator simulator = simulator_of(scene, steady_at(n));
      int frames = 0;
      while (simulator.state().u[index(a)][0] > 9.0 && frames < 30) {
        simulator.step();
        ++frames;
      }
      ASSERT_LT(frames, 30);
      EXPECT_LT((momentum(simulator.state()) - before).norm(), 1e-5 * before.norm());
    }
  }
}

}  // namespace
}  // namespace substep::test
