// Contacts that are found along the motion of a sub-step (detection continuous): drops, shots,
// misses and overlaps, of spheres and boxes, with preset `steady` and fixed numbers of sub-steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/math/turn.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_builder.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/continues.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

constexpr double kHalf = 0.1;  // radius, or half an edge [m]

const Shape kBall = Sphere{kHalf};
const Shape kCube = Box{{kHalf, kHalf, kHalf}};

struct Drop {
  Shape shape = kBall;
  double height = 1.0;  // [m]
  double mass = 1.0;    // [kg]
  double e = 0.0;
  double compliance = 1e-10;  // [m/N]
  Vec3 up = Vec3::UnitY();    // normal of the floor, against gravity
};

std::shared_ptr<const Scene> scene_of(const Drop& drop) {
  SceneBuilder builder("drop");
  const int floor = builder.add_fixed(Plane{}, Vec3::Zero());
  const Quat turn = turn_between(Vec3::UnitY(), drop.up);
  builder.body(floor).orientation = turn;
  const int body = builder.add_body(drop.shape, drop.mass, (drop.height + kHalf) * drop.up);
  builder.body(body).orientation = turn;
  builder.body(body).restitution = drop.e;
  builder.scene().gravity = -kGravity * drop.up;
  builder.scene().contact.compliance = drop.compliance;
  return builder.build();
}

struct Flight {
  double lowest = 0.0;   // gap [m]
  double rebound = 0.0;  // by the energy after the first impact, above the floor [m]
};

/// @param seconds after the impact
Flight flight_of(const Drop& drop, const Settings& settings, double seconds) {
  const double falls = std::sqrt(2.0 * drop.height / kGravity);
  Flight flight;
  bool hit = false;
  double last = 0.0;
  const EveryFrame every = [&](const Simulator& simulator, const FrameReport& report) {
    const double gap = simulator.state().x[1].dot(drop.up) - kHalf;
    const double speed = simulator.state().u_synchronised[1].head<3>().dot(drop.up);
    hit = hit || speed > last + 1e-9 || (gap < 1e-9 && report.time > falls);
    last = speed;
    flight.lowest = std::min(flight.lowest, gap);
    if (hit) keep_largest(flight.rebound, gap + 0.5 * speed * std::abs(speed) / kGravity);
    EXPECT_EQ(report.status, StepStatus::kOk);
  };
  run(*scene_of(drop), settings, falls + seconds, every, false);
  EXPECT_TRUE(hit);
  return flight;
}

std::string text_of(const Drop& drop, int n) {
  return (std::holds_alternative<Sphere>(drop.shape) ? "ball" : "cube") + std::string(" from ") +
         std::to_string(drop.height) + " m, " + std::to_string(drop.mass) + " kg, n " +
         std::to_string(n) + ", compliance exponent " + std::to_string(std::log10(drop.compliance));
}

constexpr int kSubsteps[] = {1, 4, 64, 600};

TEST(SweptContacts, WithoutRestitutionBodiesStayDown) {
  for (const Shape& shape : {kBall, kCube}) {
    for (const int n : kSubsteps) {
      for (const Drop& drop :
           {Drop{shape, 0.1, 1e-3, 0.0, 1e-8}, Drop{shape, 1.0, 1.0, 0.0, 1e-14},
            Drop{shape, 10.0, 1e4, 0.0, 1e-10}, Drop{shape, 100.0, 1.0, 0.0, 1e-8},
            Drop{shape, 10.0, 1.0, 0.0, 1e-10, Vec3{0.3, 0.8, -0.4}.normalized()}}) {
        SCOPED_TRACE(text_of(drop, n));
        const Flight flight = flight_of(drop, steady_at(n), 1.0);
        EXPECT_LT(flight.rebound, 1e-6 * drop.height);
        EXPECT_GT(flight.lowest, -1e-3 * 2.0 * kHalf);
      }
    }
  }
}

TEST(SweptContacts, ReboundsReachTheHeightThatRestitutionSays) {
  for (const Shape& shape : {kBall, kCube}) {
    for (const double e : {1.0, 0.5}) {
      for (const int n : kSubsteps) {
        for (const Drop& drop :
             {Drop{shape, 0.1, 1.0, e, 1e-8}, Drop{shape, 10.0, 1e-3, e, 1e-14},
              Drop{shape, 10.0, 1e4, e, 1e-10}, Drop{shape, 100.0, 1.0, e, 1e-10}}) {
          SCOPED_TRACE(text_of(drop, n));
          const Flight flight = flight_of(drop, steady_at(n), 0.1);
          EXPECT_NEAR(flight.rebound / (e * e * drop.height), 1.0, 0.01);
          EXPECT_GT(flight.lowest, -1e-3 * 2.0 * kHalf);
        }
      }
    }
  }
}

// With detection per sub-step a body rebounds although its restitution is 0.
TEST(SweptContacts, DetectionPerSubstepLetsAPlasticBodyRebound) {
  Settings settings;
  settings.n = 1;
  settings.mode = Mode::kConst;
  EXPECT_GT(flight_of({kBall, 10.0}, settings, 1.0).rebound, 1.0);
}

// K is skipped in a sub-step with an impact, but not if none is known.
TEST(SweptContacts, AnImpactInTheFirstSubstepNeedsNoProbe) {
  Settings settings = steady();
  for (const Mode mode : {Mode::kAdaptive, Mode::kDamping, Mode::kStiffness, Mode::kBlend}) {
    SCOPED_TRACE(name_of(mode));
    settings.mode = mode;
    settings.probe = false;
    Scene scene = *scene_of({kCube, 1e-3});
    scene.bodies[1].velocity = {0.0, -5.0, 0.0};
    Simulator simulator = simulator_of(scene, settings);
    EXPECT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_FALSE(simulator.state().k.empty());
    for (int i = 0; i < 10; ++i) EXPECT_EQ(simulator.step().status, StepStatus::kOk);
    EXPECT_LT(std::abs(simulator.state().u[1].y()), 1e-3);
  }
}

TEST(SweptContacts, HoldWithEverySolverModeAndIntegrator) {
  const auto check = [](const Settings& settings, double tolerance) {
    for (const Shape& shape : {kBall, kCube}) {
      EXPECT_LT(flight_of({shape, 1.0}, settings, 1.0).rebound, tolerance);
      const double rebound = flight_of({shape, 1.0, 1.0, 0.5}, settings, 0.1).rebound;
      const bool euler = settings.integrator == Integrator::kEuler;  // of first order
      EXPECT_NEAR(rebound / 0.25, 1.0, euler ? 0.03 : 0.01);
    }
  };
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
    for (const SolverKind solver :
         {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kXpbd, SolverKind::kNewton}) {
      SCOPED_TRACE(std::string(name_of(integrator)) + " " + std::string(name_of(solver)));
      Settings settings = steady_at(4);
      settings.integrator = integrator;
      settings.solver = solver;
      check(settings, 1e-6);
    }
  }
  for (const Mode mode : {Mode::kNone, Mode::kAdaptive, Mode::kStiffness, Mode::kBlend}) {
    SCOPED_TRACE(name_of(mode));
    Settings settings = steady_at(4);
    settings.mode = mode;
    check(settings, 1e-6);
  }
}

/// A body shot at a wall of 0.1 m, or past its upper edge.
std::shared_ptr<const Scene> shot(const Shape& shape, double speed, double y, const Vec3& omega) {
  SceneBuilder builder("shot");
  builder.add_fixed(Box{{0.05, 2.0, 2.0}}, Vec3::Zero());
  const int body = builder.add_body(shape, 1.0, {-3.0, y, 0.3});
  builder.body(body).velocity = {speed, 0.0, 0.0};
  builder.body(body).angular_velocity = omega;
  builder.scene().gravity.setZero();
  return builder.build();
}

TEST(SweptContacts, NothingPassesThroughAWall) {
  for (const Shape& shape : {kBall, kCube}) {
    for (const double speed : {60.0, 300.0}) {
      for (const int n : kSubsteps) {
        for (const Vec3& omega : {Vec3{0.0, 0.0, 0.0}, Vec3{3.0, 20.0, 7.0}}) {
          SCOPED_TRACE(std::to_string(speed) + " m/s, n " + std::to_string(n));
          Simulator simulator = simulator_of(shot(shape, speed, 0.1, omega), steady_at(n));
          double energy = 0.0;
          for (int i = 0; i < 20; ++i) {
            const FrameReport report = simulator.step();
            ASSERT_EQ(report.status, StepStatus::kOk);
            EXPECT_LT(simulator.state().x[1].x(), -0.05 - 0.99 * kHalf);
            if (i > 0) {
              EXPECT_LE(report.energy, energy + 1e-9 * speed * speed);
            }
            energy = report.energy;
          }
        }
      }
    }
  }
}

/// Spheres and boxes of different size, mass and friction that fall onto a floor, tumbling.
Scene random_pile(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const auto vector = [&](double most) {
    const double x = between(-most, most);
    const double y = between(-most, most);
    return Vec3{x, y, between(-most, most)};
  };
  SceneBuilder builder("pile");
  builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = 0.5;
  const int count = 4 + static_cast<int>(seed % 10);
  for (int i = 0; i < count; ++i) {
    const Vec3 half = Vec3::Constant(0.25) + vector(0.15);
    const Shape shape = between(0.0, 1.0) < 0.5 ? Shape(Sphere{half.x()}) : Shape(Box{half});
    const double density = std::pow(10.0, between(2.0, 4.0));
    const Vec3 at = vector(0.5);
    const int body =
        builder.add_body(shape, density * half.prod(), {at.x(), 1.0 + 0.9 * i, at.z()});
    const Vec3 axis = vector(1.0);
    builder.body(body).orientation = Quat(between(-1.0, 1.0), axis.x(), axis.y(), axis.z());
    builder.body(body).orientation.normalize();
    builder.body(body).velocity = vector(1.0) - Vec3{0.0, 1.5, 0.0};
    builder.body(body).angular_velocity = vector(5.0);
    builder.body(body).friction = between(0.0, 0.8);
  }
  return *builder.build();
}

TEST(SweptContacts, DetectionPerSubstepLetsAFastBodyPass) {
  Settings settings;
  settings.n = 1;
  settings.mode = Mode::kConst;
  Simulator simulator = simulator_of(shot(kBall, 300.0, 0.1, Vec3::Zero()), settings);
  for (int i = 0; i < 20; ++i) simulator.step();
  EXPECT_GT(simulator.state().x[1].x(), 0.05);
}

TEST(SweptContacts, TooManyContactsAlongTheMotionAreRefused) {
  Scene scene = random_pile(9);
  Simulator simulator = simulator_of(scene, steady());
  Budget budget;
  budget.contacts = 1.0;
  simulator.set_budget(budget);
  StepStatus status = StepStatus::kOk;
  for (int i = 0; i < 120 && status == StepStatus::kOk; ++i) status = simulator.step().status;
  EXPECT_EQ(status, StepStatus::kTooManyContacts);
}

TEST(SweptContacts, WhatMissesIsNotTouched) {
  for (const Shape& shape : {kBall, kCube}) {
    for (const double speed : {6.0, 60.0, 300.0}) {
      for (const int n : {1, 2, 3, 4, 16, 64, 600}) {
        SCOPED_TRACE(std::to_string(speed) + " m/s, n " + std::to_string(n));
        const auto scene = shot(shape, speed, 2.0 + kHalf + 1e-3, Vec3::Zero());
        Simulator simulator = simulator_of(scene, steady_at(n));
        for (int i = 0; i < 60; ++i) simulator.step();
        EXPECT_GT(simulator.state().x[1].x(), 0.5);
        EXPECT_EQ(simulator.state().u[1], initial_state(*scene).u[1]);
      }
    }
  }
}

TEST(SweptContacts, PartOverlapsWithoutSpeed) {
  for (const int n : kSubsteps) {
    SCOPED_TRACE(n);
    SceneBuilder builder("overlap");
    builder.add_fixed(Plane{}, Vec3::Zero());
    builder.add_body(kCube, 1.0, {0.0, kHalf, 0.0});
    builder.add_body(kCube, 100.0, {0.02, 2.2 * kHalf, 0.01});  // 0.08 m deep
    for (int body = 0; body < 3; ++body) builder.body(body).friction = 0.5;
    Simulator simulator = simulator_of(builder.build(), steady_at(n));
    double last = simulator.state().x[2].y();
    for (int i = 0; i < 120; ++i) {
      const FrameReport report = simulator.step();
      EXPECT_LT(report.kinetic, 1e-3) << i;
      const double y = simulator.state().x[2].y();
      EXPECT_LT(std::abs(y - last), 1.5 * kHalf / 60.0);  // a half width per second, from either
      last = y;
    }
    EXPECT_NEAR(last, 3.0 * kHalf, 1e-3 * kHalf);
  }
}

TEST(SweptContacts, ALightBodyUnderAHeavyOneStaysWhole) {
  for (const int n : kSubsteps) {
    SCOPED_TRACE(n);
    SceneBuilder builder("heavy_on_light");
    builder.add_fixed(Plane{}, Vec3::Zero());
    builder.add_body(kCube, 1.0, {0.0, kHalf, 0.0});
    builder.add_body(kCube, 1000.0, {0.0, 3.0 * kHalf + 10.0, 0.0});
    Simulator simulator = simulator_of(builder.build(), steady_at(n));
    double highest = 0.0;
    for (int i = 0; i < 150; ++i) {
      const FrameReport report = simulator.step();
      EXPECT_LT(report.penetration, 1e-3 * 2.0 * kHalf) << i;
      if (report.time > 1.5) keep_largest(highest, simulator.state().x[2].y());
    }
    EXPECT_LT(highest, 3.0 * kHalf + 1e-3);
  }
}

// Parting lifts the upper cube; its work is reported, and is no gain of energy.
TEST(SweptContacts, TheVerdictTellsPartingFromAGain) {
  SceneBuilder builder("overlap");
  builder.add_fixed(Plane{}, Vec3::Zero());
  builder.add_body(kCube, 1.0, {0.0, kHalf, 0.0});
  const int upper = builder.add_body(kCube, 100.0, {0.0, 2.2 * kHalf, 0.0});
  const Scene scene = *builder.build();
  double parting = 0.0;
  const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
    parting += report.parting;
  };
  const Outcome ours = run(scene, steady(), 2.0, every);
  EXPECT_EQ(ours.verdict, "holds");
  const double lifted = ours.end.x[static_cast<std::size_t>(upper)].y() - 2.2 * kHalf;
  EXPECT_GT(lifted, 0.7 * kHalf);
  EXPECT_NEAR(parting, 100.0 * kGravity * lifted, 0.02 * parting);
  const std::string paper = run(scene, Settings{}, 2.0).verdict;
  EXPECT_NE(paper.find("energy gain"), std::string::npos) << paper;
}

TEST(SweptContacts, TheVerdictNamesWhoIsInsideWhom) {
  const std::shared_ptr<const Scene> scene = scene_of({kBall, 10.0});
  EXPECT_EQ(run(*scene, steady(), 3.0).verdict, "holds");
  const std::string paper = run(*scene, Settings{.mode = Mode::kConst, .n = 1}, 3.0).verdict;
  EXPECT_NE(paper.find("overlap"), std::string::npos) << paper;
  EXPECT_NE(paper.find("(body_1, body_0)"), std::string::npos) << paper;
}

// Passive scenes with default e: the energy never rises.
TEST(SweptContacts, PassiveScenesGainNoEnergy) {
  for (const Scene& scene : {scenes::wall(), scenes::wrecking_ball(), scenes::bouncing_balls(),
                             scenes::card_house(), scenes::heavy_stack()}) {
    SCOPED_TRACE(scene.name);
    double lowest = std::numeric_limits<double>::infinity();
    double rise = 0.0;
    double kinetic = 0.0;
    double weight = 0.0;  // times a metre
    for (const Body& body : scene.bodies) weight += body.is_static ? 0.0 : kGravity * body.mass;
    const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
      EXPECT_EQ(report.status, StepStatus::kOk);
      lowest = std::min(lowest, report.energy);
      keep_largest(rise, report.energy - lowest);
      keep_largest(kinetic, report.kinetic);
    };
    run(scene, steady(), 3.0, every, false);
    // Parting the overlap that is allowed lifts what lies on it.
    EXPECT_LT(rise, std::max(0.01 * kinetic, 1e-5 * weight));
  }
}

/// The rise of the energy over its lowest value so far, in parts of the largest kinetic energy.
double rise_of(const Scene& scene, const Settings& settings, double seconds) {
  double lowest = std::numeric_limits<double>::infinity();
  double rise = 0.0;
  double kinetic = 0.0;
  const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
    EXPECT_EQ(report.status, StepStatus::kOk);
    lowest = std::min(lowest, report.energy);
    keep_largest(rise, report.energy - lowest);
    keep_largest(kinetic, report.kinetic);
  };
  run(scene, settings, seconds, every, false);
  return rise / kinetic;
}

// With the paper's contacts many of them do.
TEST(SweptContacts, RandomPilesGainNoEnergy) {
  int gains = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Scene scene = random_pile(seed);
    EXPECT_LT(rise_of(scene, steady(), 4.0), 0.01) << seed;
    if (rise_of(scene, Settings{}, 4.0) > 0.01) ++gains;
  }
  EXPECT_GT(gains, 20);
}

TEST(SweptContacts, ContinueBitForBit) {
  for (const Scene& of : {scenes::wrecking_ball(), scenes::bouncing_balls()}) {
    SCOPED_TRACE(of.name);
    const auto scene = shared(of);
    const Settings& settings = steady();
    Simulator whole = simulator_of(scene, settings);
    Simulator parts = simulator_of(scene, settings);
    for (int i = 0; i < 66; ++i) {
      whole.step();
      do parts.step_some(1.0);
      while (parts.substeps_left() > 0);
      ASSERT_EQ(state_hash(whole.state()), state_hash(parts.state())) << i;
    }
    expect_continues(whole, 30);
  }
}

// A ball on an arm rests on a rod that falls with it, as on a cam. Joints close on the curved
// motion, and the contact must let both turn.
TEST(SweptContacts, ABallOnAFallingRodKeepsItsEnergy) {
  constexpr double kRadius = 0.1;
  constexpr double kHalfHeight = 0.05;  // of the rod
  constexpr double kRate = -3.0;        // [rad/s]
  SceneBuilder builder("cam");
  const int ball = builder.add_body(Sphere{kRadius}, 1.0, {1.0, 0.0, 0.0});
  const int rod =
      builder.add_body(Box{{1.0, kHalfHeight, 0.1}}, 1.0, {1.0, -kRadius - kHalfHeight, 0.0});
  builder.add_hinge(ball, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_hinge(rod, kWorld, {0.0, -kRadius - kHalfHeight, 0.0}, Vec3::UnitZ());
  for (const int body : {ball, rod}) {
    builder.body(body).friction = 0.0;
    builder.body(body).velocity = {0.0, kRate, 0.0};
    builder.body(body).angular_velocity = {0.0, 0.0, kRate};
  }
  Settings settings = steady();
  settings.mode = Mode::kConst;
  settings.n = 4;
  Simulator simulator = simulator_of(shared(*builder.build()), settings);
  const double start = simulator.observe().energy;
  double change = 0.0;
  double kinetic = 0.0;
  for (int i = 0; i < 24; ++i) {
    const FrameReport report = simulator.step();
    keep_largest(change, std::abs(report.energy - start));
    keep_largest(kinetic, report.kinetic);
  }
  EXPECT_LT(change, 2e-4 * kinetic);
}

// With both solved for, a joint does not push a body into a contact.
TEST(SweptContacts, HoldTogetherWithExactJoints) {
  SceneBuilder builder("pendulum_on_floor");
  builder.add_fixed(Plane{}, {0.0, -0.8, 0.0});
  const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  const int ball = builder.add_body(Sphere{0.2}, 10.0, {1.2, 0.0, 0.0});
  builder.add_ball_joint(rod, kWorld, Vec3::Zero());
  builder.add_ball_joint(ball, rod, {1.0, 0.0, 0.0});
  const Settings& settings = steady();
  double deepest = 0.0;
  double gap = 0.0;
  const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
    EXPECT_EQ(report.status, StepStatus::kOk);
    keep_largest(deepest, report.penetration);
    keep_largest(gap, report.joint_gap);
  };
  run(*builder.build(), settings, 5.0, every, false);
  EXPECT_LT(deepest, 1e-3 * 0.2);
  EXPECT_LT(gap, 1e-9);
}

}  // namespace
}  // namespace substep::test
