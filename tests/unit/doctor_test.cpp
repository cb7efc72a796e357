// The step doctor: what it names, what it says of drives, and its checks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/lab/doctor.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

Diagnosis at_start(const Scene& scene, double step, const char* engine = "substep", int held = 0) {
  DoctorQuestion question;
  question.step = step;
  question.engine = engine_of(engine);
  question.held = held;
  question.runs = false;
  return diagnose(std::make_shared<const Scene>(scene), question);
}

/// A chain of rods with a heavy ball at its end, hanging.
SceneBuilder hanging(double load) {
  SceneBuilder builder("hanging");
  int above = kWorld;
  for (int i = 0; i < 4; ++i) {
    const int link = builder.add_body(Box{{0.03, 0.1, 0.05}}, 1.0, {0.0, -0.1 - 0.2 * i, 0.0});
    builder.body(link).collides = false;
    builder.add_hinge(link, above, {0.0, -0.2 * i, 0.0}, i % 2 ? Vec3::UnitX() : Vec3::UnitZ());
    above = link;
  }
  const int ball = builder.add_body(Sphere{0.1}, load, {0.0, -0.9, 0.0});
  builder.body(ball).collides = false;
  builder.add_ball_joint(ball, above, {0.0, -0.8, 0.0});
  return builder;
}

// The joint that it names moves the limit most: the force of a joint counts by its share. Here by
// the mass of the ball, which loads every joint, and by the moments of the body that moves most.
TEST(Doctor, NamesWhatMovesTheLimit) {
  const Scene scene = *hanging(500.0).build();
  const Diagnosis d = at_start(scene, 1.0 / 60.0);
  ASSERT_EQ(d.start.size(), 1U);
  const GroupLimit& limit = d.start[0];
  EXPECT_LT(limit.step, 1.0 / 60.0);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::kFails);
  EXPECT_EQ(limit.step, limit.geometric);
  double sum = 0.0;
  for (const auto& share : limit.joints) sum += share.share;
  EXPECT_NEAR(sum, 1.0, 1e-9);
  // d(log w^2)/d(log moments) = -share of the rotation, at most that of the body.
  const int body = limit.bodies[0].index;
  double best = 0.0;
  int moves_most = -1;
  for (int i = 0; i < 5; ++i) {
    Scene changed = scene;
    changed.bodies[index(i)].inertia *= 1.01;
    changed.bodies[index(i)].mass *= 1.01;
    const double grown = at_start(changed, 1.0 / 60.0).start[0].step / limit.step - 1.0;
    if (grown > best) {
      best = grown;
      moves_most = i;
    }
  }
  EXPECT_EQ(moves_most, body);
  EXPECT_NEAR(2.0 * best / 0.01, limit.bodies[0].share, 0.1);
}

// The step of the analysis is the one at which the paper's scheme fails: a small disturbance of the
// hanging chain grows above it and does not below.
TEST(Doctor, ForetellsTheLargestStepOfAHangingChain) {
  const Scene scene = *hanging(200.0).build();
  const double limit = at_start(scene, 1.0 / 60.0).start[0].step;
  for (const double share : {0.95, 1.05}) {
    Scene run = scene;
    run.frame = share * limit;
    run.bodies[1].angular_velocity = {0.0, 0.0, 1e-6};
    run.bodies[2].angular_velocity = {1e-6, 0.0, 0.0};
    Settings settings = kPaperSettings;
    settings.mode = Mode::kConst;
    settings.n = 1;
    settings.drift = Drift::kFull;
    Simulator simulator(std::make_shared<const Scene>(run));
    simulator.set_settings(settings);
    double most = 0.0;
    for (int i = 0; i < 400; ++i) {
      ASSERT_EQ(simulator.step().status, StepStatus::kOk);
      for (const Vec6& u : simulator.state().u) most = std::max(most, u.norm());
    }
    EXPECT_EQ(most > 1e-3, share > 1.0) << most;
  }
}

/// Five rods on ball joints, turned out of the vertical about two axes.
Scene rods_on_balls(double angle) {
  SceneBuilder builder("rods on ball joints");
  const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitX()) *
                  Eigen::AngleAxisd(0.5 * angle, Vec3::UnitZ()));
  int above = kWorld;
  for (int i = 0; i < 5; ++i) {
    const auto at = [&](double y) { return Vec3(turn * Vec3(0.0, y, 0.0)); };
    const int rod = builder.add_body(Box{{0.02, 0.15, 0.02}}, 1.0, at(-0.15 - 0.3 * i));
    builder.body(rod).orientation = turn;
    builder.body(rod).collides = false;
    builder.add_ball_joint(rod, above, at(-0.3 * i));
    above = rod;
  }
  return *builder.build();
}

// With the paper's drift law the run gained energy at 0.4 of this step: the motion with joints that
// hold does not. Nearer to the limit the energy swings, which is no reason to fail.
TEST(Doctor, RunsOfChainsOfBallJointsHoldBelowTheLargestStep) {
  for (const double angle : {0.0, 0.3, 0.5}) {
    const auto scene = std::make_shared<const Scene>(rods_on_balls(angle));
    DoctorQuestion question;
    question.seconds = 5.0;
    question.step = 0.001;
    const double step = diagnose(scene, question).step;
    for (const double share : {0.4, 0.7, 0.9, 1.05}) {
      question.step = share * step;
      const Diagnosis d = diagnose(scene, question);
      using Verdict = Diagnosis::Verdict;
      EXPECT_EQ(d.at_step->holds, share < 1.0) << angle << " " << share << d.at_step->verdict;
      EXPECT_EQ(d.verdict, share > 1.0   ? Verdict::kFails
                           : share > 0.8 ? Verdict::kHoldsNarrowly
                                         : Verdict::kHolds)
          << angle << " " << share;
    }
  }
}

// What moves fast gains energy by forces that MuJoCo treats explicitly, at any step: it is said,
// for MuJoCo alone, and the shorter step that is offered is short enough.
TEST(Doctor, TellsTheGainByForcesThatMuJoCoTreatsExplicitly) {
  const auto ask = [](double angle, double step, const char* engine) {
    DoctorQuestion question;
    question.engine = engine_of(engine);
    question.seconds = 5.0;
    question.step = step;
    return diagnose(std::make_shared<const Scene>(rods_on_balls(angle)), question);
  };
  const auto tells = [](const Diagnosis& d) {
    return std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& finding) {
      return finding.fails && finding.text.find("Coriolis") != std::string::npos;
    });
  };
  const Diagnosis fast = ask(0.8, 0.02, "mujoco");
  EXPECT_GT(fast.step, 1.4 * 0.02) << "the linearised motion allows it";
  EXPECT_TRUE(tells(fast));
  EXPECT_EQ(fast.verdict, Diagnosis::Verdict::kFails);
  EXPECT_TRUE(tells(ask(0.8, 0.02, "mujoco-implicitfast")));
  EXPECT_FALSE(tells(ask(0.8, 0.02, "substep")));
  EXPECT_EQ(ask(0.2, 0.02, "mujoco").verdict, Diagnosis::Verdict::kHolds);
  const auto shorter =
      std::find_if(fast.remedies.begin(), fast.remedies.end(),
                   [](const TriedRemedy& of) { return of.shorter > 0.0 && of.holds; });
  ASSERT_NE(shorter, fast.remedies.end());
  EXPECT_FALSE(tells(ask(0.8, shorter->shorter, "mujoco")));
}

// The limit itself, in runs that need no verdict: small motions of the chain stay small for 2,000
// steps below it and grow without bound above it.
TEST(Doctor, StepOfAChainOfBallJointsIsTheLimitOfItsRun) {
  const Scene scene = rods_on_balls(0.0);
  const double limit = at_start(scene, 0.01).step;
  for (const double share : {0.3, 0.6, 0.97, 1.03}) {
    const Scene run = scene_at_step(scene, share * limit);
    Simulator simulator(std::make_shared<const Scene>(run));
    double most = 0.0;
    for (int i = 0; i < 2000; ++i) {
      if (simulator.step().status != StepStatus::kOk) break;
      most = std::max(most, simulator.observe().kinetic);
    }
    EXPECT_EQ(most > 0.1, share > 1.0) << share << ": " << most;
  }
}

SceneBuilder driven_rod(double stiffness, double damping) {
  SceneBuilder builder("driven rod");
  const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  builder.drive(builder.add_hinge(rod, kWorld, Vec3::Zero(), Vec3::UnitZ()),
                {.stiffness = stiffness, .damping = damping});
  builder.scene().gravity.setZero();
  return builder;
}

TEST(Doctor, TellsDrivesByTheirEngine) {
  const Scene scene = *driven_rod(2000.0, 20.0).build();
  const double inertia = scene.bodies[0].inertia.z() + 0.25;
  const double bare = largest_step(OneCoordinate{inertia, 2000.0, 20.0, 0.0});
  const double damped = largest_step(OneCoordinate{inertia, 2000.0, 0.0, 20.0});
  EXPECT_EQ(at_start(scene, 0.01).verdict, Diagnosis::Verdict::kHolds);
  EXPECT_FALSE(std::isfinite(at_start(scene, 0.01).step));
  const Diagnosis euler = at_start(scene, 0.02, "mujoco");
  ASSERT_EQ(euler.drives.size(), 1U);
  EXPECT_NEAR(euler.drives[0].inertia, inertia, 1e-12);
  EXPECT_NEAR(euler.step, bare, 1e-9);
  EXPECT_NEAR(euler.start[0].step, bare, 1e-9) << "the matrix rule and that of one coordinate";
  EXPECT_EQ(euler.limited_by.find("the drive of joint_0"), 0U) << euler.limited_by;
  EXPECT_NEAR(at_start(scene, 0.02, "mujoco-implicitfast").step, damped, 1e-9);
  EXPECT_FALSE(std::isfinite(at_start(scene, 0.02, "drake").step));
  // Exit by the margin.
  EXPECT_EQ(at_start(scene, bare / 1.5, "mujoco").verdict, Diagnosis::Verdict::kHolds);
  EXPECT_EQ(at_start(scene, bare / 1.2, "mujoco").verdict, Diagnosis::Verdict::kHoldsNarrowly);
  EXPECT_EQ(at_start(scene, bare * 1.1, "mujoco").verdict, Diagnosis::Verdict::kFails);
  // The armature that it proposes holds with the margin.
  const double asked = 1.5 * bare;
  const double armature = at_start(scene, asked, "mujoco").drives[0].armature;
  EXPECT_GT(armature, 0.0);
  SceneBuilder with = driven_rod(2000.0, 20.0);
  with.add_armature(0, 1.0001 * armature);
  EXPECT_EQ(at_start(*with.build(), asked, "mujoco").verdict, Diagnosis::Verdict::kHolds);
}

// MuJoCo's Euler takes the damping of joints implicitly, and that of actuators not.
TEST(Doctor, TellsSpringsFromDrives) {
  const auto rod_with = [](std::optional<Spring> spring, std::optional<Drive> drive) {
    SceneBuilder builder("sprung rod");
    const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
    const int hinge = builder.add_hinge(rod, kWorld, Vec3::Zero(), Vec3::UnitZ());
    if (spring) builder.add_spring(hinge, *spring);
    if (drive) builder.drive(hinge, *drive);
    builder.scene().gravity.setZero();
    return *builder.build();
  };
  const Scene sprung = rod_with(Spring{0.0, 2000.0, 20.0}, std::nullopt);
  const double inertia = sprung.bodies[0].inertia.z() + 0.25;
  const Diagnosis of_spring = at_start(sprung, 0.2, "mujoco");
  EXPECT_NEAR(of_spring.step, largest_step(OneCoordinate{inertia, 2000.0, 0.0, 20.0}), 1e-9);
  EXPECT_EQ(of_spring.limited_by, "the spring of joint_0 at the start");
  EXPECT_TRUE(of_spring.start[0].joints.empty()) << "no geometric stiffness resists";
  EXPECT_FALSE(std::isfinite(at_start(sprung, 0.2).step));
  EXPECT_FALSE(std::isfinite(at_start(sprung, 0.2, "substep", 4).step)) << "it is in the engine";
  const Scene both = rod_with(Spring{0.0, 1500.0, 5.0}, Drive{.stiffness = 500.0, .damping = 15.0});
  const Diagnosis of_both = at_start(both, 0.2, "mujoco");
  ASSERT_EQ(of_both.drives.size(), 1U);
  EXPECT_NEAR(of_both.step, largest_step(OneCoordinate{inertia, 2000.0, 15.0, 5.0}), 1e-9);
  EXPECT_NEAR(of_both.drives[0].step, of_both.step, 1e-9) << "the rule of one coordinate";
  EXPECT_EQ(of_both.limited_by, "the drive and spring of joint_0 at the start");
  const Diagnosis held = at_start(both, 0.2, "substep", 4);
  EXPECT_NEAR(held.drives[0].held_step, largest_step_of_effort({inertia, 500.0, 15.0, 4}), 1e-9)
      << "of the drive alone";
}

// A mode of several drives, none of which has half of its stiffness, is limited by drives.
TEST(Doctor, NamesDrivesThatLimitTogether) {
  SceneBuilder builder("three bodies on slides of a light one");
  const int hub = builder.add_body(Sphere{0.1}, 0.1, Vec3::Zero());
  builder.body(hub).collides = false;
  for (int i = 0; i < 3; ++i) {
    const int body = builder.add_body(Sphere{0.1}, 1.0, Vec3::Zero());
    builder.body(body).collides = false;
    builder.drive(builder.add_prismatic(body, hub, Vec3::Zero(), Vec3::UnitX()),
                  {.stiffness = 1e5 + 1e3 * i});
  }
  const Diagnosis d = at_start(*builder.build(), 1.0 / 60.0, "mujoco");
  ASSERT_EQ(d.start.size(), 1U);
  EXPECT_LT(d.start[0].drives[0].share, 0.5) << "else one is named";
  EXPECT_TRUE(d.by_drive);
  EXPECT_EQ(d.limited_by, "the drives of joint_2 and joint_1 together at the start");
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::kFails);
}

// kd > kp h (n - 1)/2, whatever the armature.
TEST(Doctor, FindsAHeldLawWithTooLittleDamping) {
  for (const double armature : {1e-3, 1.0, 1e3}) {
    SceneBuilder builder = driven_rod(100.0, 0.5);
    builder.add_armature(0, armature);
    const Diagnosis d = at_start(*builder.build(), 0.005, "mujoco", 4);
    EXPECT_EQ(d.verdict, Diagnosis::Verdict::kFails) << armature;
    EXPECT_NE(d.limited_by.find("too little damping"), std::string::npos) << d.limited_by;
    EXPECT_NEAR(d.drives[0].delay_step, 2.0 * 0.5 / 300.0, 1e-12);
  }
}

// The run with the asked step fails, and what holds is named with its price.
TEST(Doctor, TriesItsRemedies) {
  DoctorQuestion question;
  question.step = 1.0 / 60.0;
  question.seconds = 1.0;
  const auto scene = hanging(500.0).build();
  const Diagnosis d = diagnose(scene, question);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::kFails);
  ASSERT_EQ(d.runs.size(), 2U);
  for (const DoctorRun& run : d.runs) {
    EXPECT_TRUE(run.holds) << run.verdict;
    EXPECT_EQ(run.criterion.size(), 60U);
    ASSERT_EQ(run.worst.size(), 1U);
    EXPECT_LT(run.worst[0].step, question.step);
  }
  ASSERT_TRUE(d.at_step);
  EXPECT_FALSE(d.at_step->holds);
  int holds = 0;
  bool armature = false;
  for (const TriedRemedy& tried : d.remedies) {
    holds += tried.holds;
    EXPECT_GT(tried.operations, 0.0) << tried.text;
    if (tried.text.find("armature") == std::string::npos) continue;
    armature = true;
    // Its energy may still be off: the run says so.
    EXPECT_GE(tried.step, 1.4 * question.step) << tried.text;
  }
  EXPECT_TRUE(armature);
  EXPECT_GE(holds, 3);
  // The same question has the same answer.
  const Diagnosis again = diagnose(scene, question);
  ASSERT_EQ(again.remedies.size(), d.remedies.size());
  for (std::size_t i = 0; i < d.remedies.size(); ++i) {
    EXPECT_EQ(again.remedies[i].operations, d.remedies[i].operations);
    EXPECT_EQ(again.remedies[i].moved, d.remedies[i].moved);
  }
}

// The drives of a run are implicit: other methods hold there whatever the engine does with them.
TEST(Doctor, OffersAgainstADriveOnlyWhatItsEngineHolds) {
  const auto scene = driven_rod(2000.0, 20.0).build();
  DoctorQuestion question;
  question.engine = engine_of("mujoco");
  question.step = 1.5 * at_start(*scene, 0.02, "mujoco").step;
  question.seconds = 0.5;
  const Diagnosis d = diagnose(scene, question);
  EXPECT_TRUE(d.by_drive);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::kFails);
  int shorter = 0;
  int changes = 0;
  for (const TriedRemedy& tried : d.remedies) {
    if (tried.text.starts_with("substep's")) continue;  // another engine
    const bool is_shorter = tried.shorter > 0.0;
    (is_shorter ? shorter : changes) += 1;
    const double step = is_shorter ? tried.shorter : question.step;
    EXPECT_GE(tried.step, 1.399 * step) << tried.text;
    EXPECT_TRUE(tried.holds) << tried.text;
  }
  EXPECT_EQ(shorter, 1);
  EXPECT_GE(changes, 1);
}

// Geometric stiffness sets the limit, and a drive alone would allow less than the asked step, too.
TEST(Doctor, OffersNoMethodThatLeavesADriveTooStiff) {
  const auto methods = [](double share) {
    DoctorQuestion question;
    question.engine = engine_of("mujoco");
    question.step = 1.0 / 60.0;
    question.seconds = 0.2;
    SceneBuilder builder = hanging(500.0);
    builder.drive(0, {.stiffness = 1.0, .damping = 0.0});
    const Scene soft = *builder.build();
    const double step = share * question.step;
    SceneBuilder stiffer = hanging(500.0);
    stiffer.drive(
        0, {.stiffness = 4.0 * at_start(soft, 0.02, "mujoco").drives[0].inertia / (step * step),
            .damping = 0.0});
    const Diagnosis d = diagnose(stiffer.build(), question);
    EXPECT_FALSE(d.by_drive) << d.limited_by;
    return std::count_if(d.remedies.begin(), d.remedies.end(), [](const TriedRemedy& tried) {
      return tried.text.ends_with("at this step");
    });
  };
  EXPECT_EQ(methods(0.9), 0);
  EXPECT_EQ(methods(3.0), 2);
}

bool warns(const Diagnosis& d, const std::string& of) {
  return std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& finding) {
    return finding.text.find(of) != std::string::npos;
  });
}

TEST(Doctor, ChecksWhatNeedsNoRun) {
  const Diagnosis heavy = at_start(*hanging(500.0).build(), 0.01);
  EXPECT_TRUE(warns(heavy, "masses differ by a factor of 500 across joint_4"));
  EXPECT_FALSE(warns(at_start(*hanging(50.0).build(), 0.01), "masses differ"));
  EXPECT_TRUE(
      warns(at_start(*driven_rod(10.0, 0.0).build(), 0.01), "neither damping nor armature"));
  EXPECT_FALSE(warns(at_start(*driven_rod(10.0, 0.1).build(), 0.01), "neither damping"));
  SceneBuilder thin = hanging(1.0);
  thin.body(2).inertia = {1e-9, 1e-9, 1e-9};
  EXPECT_TRUE(warns(at_start(*thin.build(), 0.01), "the smallest moment of inertia of body_2"));
  SceneBuilder two("two");
  two.add_body(Sphere{0.5}, 1.0, {0.0, 1.0, 0.0});
  two.add_body(Sphere{0.5}, 1.0, {0.8, 1.0, 0.0});
  EXPECT_TRUE(warns(at_start(*two.build(), 0.01), "body_0 and body_1 overlap at the start"));
  SceneBuilder door("door");
  const int of_door = door.add_body(Box{{0.5, 1.0, 0.05}}, 5.0, {0.5, 0.0, 0.0});
  door.add_hinge(of_door, kWorld, {0.0, 0.8, 0.0}, Vec3::UnitY());
  door.add_hinge(of_door, kWorld, {0.0, -0.8, 0.0}, Vec3::UnitY());
  EXPECT_TRUE(
      warns(at_start(*door.build(), 0.01), "group of body_0: 5; its joint forces are not unique"));
}

TEST(Doctor, RefusesWhatCannotRun) {
  Scene scene = *hanging(1.0).build();
  scene.bodies[1].mass = -1.0;
  const Diagnosis d = at_start(scene, 0.01);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::kNotUnderstood);
  EXPECT_NE(d.problem.find("mass"), std::string::npos);
  EXPECT_EQ(diagnose(nullptr, {}).verdict, Diagnosis::Verdict::kNotUnderstood);
}

TEST(Doctor, SaysTheSettingOfEveryEngine) {
  for (const Engine& engine : kEngines) {
    const std::string text = setting_of(engine, 0.00125, 14);
    EXPECT_EQ(text.find('%'), std::string::npos) << text;
    EXPECT_TRUE(text.find("0.00125") != std::string::npos || text.find("14") != std::string::npos);
    EXPECT_EQ(engine_of(engine.name), &engine);
  }
  EXPECT_EQ(engine_of("none"), nullptr);
}

}  // namespace
}  // namespace substep
