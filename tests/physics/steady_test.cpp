// Adaptive sub-steps that do not gain energy: preset `steady`, on mechanisms on which the paper's
// rule does. Conservative scenes of rigid joints without contacts, in a plane and in space, with
// loops and a slide; masses differ by up to 100.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/lab/presets.hpp"
#include "core/math/turn.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_builder.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/continues.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"

namespace substep::test {
namespace {

const Vec3 kOrigin = Vec3::Zero();

/// A rod from one point to another.
int add_rod(SceneBuilder& builder, const Vec3& from, const Vec3& to, double mass) {
  const Vec3 along = to - from;
  const int body =
      builder.add_body(Box{{0.5 * along.norm(), 0.025, 0.025}}, mass, 0.5 * (from + to));
  builder.body(body).orientation = turn_between(Vec3::UnitX(), along);
  return body;
}

/// Gives a rod that turns about a point of the world its velocities.
void spin(Body& body, const Vec3& about, const Vec3& omega) {
  body.angular_velocity = omega;
  body.velocity = omega.cross(body.position - about);
}

/// A crank of 0.5 m at 30 rad/s, a coupler of 2 m and a rocker of 1.5 m, from the world to the
/// world: its joint forces vary with every turn. @param turn of the whole, gravity included
Scene crank_rocker(const Quat& turn) {
  const Vec3 ground{2.0, 0.0, 0.0};
  const double angle = std::numbers::pi / 3.0;
  const Vec3 crank_end = 0.5 * Vec3{std::cos(angle), std::sin(angle), 0.0};
  // Where circles of 2 m about the crank's end and of 1.5 m about the other pivot meet.
  const Vec3 between = ground - crank_end;
  const double d = between.norm();
  const double along = (d * d + 2.0 * 2.0 - 1.5 * 1.5) / (2.0 * d);
  const double across = std::sqrt(2.0 * 2.0 - along * along);
  const Vec3 e = between / d;
  const Vec3 rocker_end = crank_end + along * e + across * Vec3::UnitZ().cross(e);
  const Vec3 axis = turn * Vec3::UnitZ();
  SceneBuilder builder("crank_rocker");
  const int crank = add_rod(builder, kOrigin, turn * crank_end, 0.5);
  const int coupler = add_rod(builder, turn * crank_end, turn * rocker_end, 1.0);
  const int rocker = add_rod(builder, turn * rocker_end, turn * ground, 1.0);
  // Speeds of coupler and rocker, from the velocity of their common pin.
  const Vec3 arm = rocker_end - crank_end;
  const Vec3 swing = rocker_end - ground;
  const Vec3 end_velocity = 30.0 * Vec3::UnitZ().cross(crank_end);
  Eigen::Matrix2d columns;
  columns << -arm.y(), swing.y(), arm.x(), -swing.x();
  const Eigen::Vector2d speeds = columns.inverse() * -end_velocity.head<2>();
  spin(builder.body(crank), kOrigin, 30.0 * axis);
  spin(builder.body(coupler), turn * crank_end, speeds[0] * axis);
  builder.body(coupler).velocity += turn * end_velocity;
  spin(builder.body(rocker), turn * ground, speeds[1] * axis);
  builder.add_hinge(crank, kWorld, kOrigin, axis);
  builder.add_hinge(coupler, crank, turn * crank_end, axis);
  builder.add_hinge(rocker, coupler, turn * rocker_end, axis);
  builder.add_hinge(rocker, kWorld, turn * ground, axis);
  builder.scene().gravity = turn * Vec3{0.0, -kGravity, 0.0};
  builder.scene().criteria.track = rocker;
  return *builder.build();
}

/// Eight light rods and a heavy ball, thrown up on a slack rope that snaps tight.
Scene thrown_rope() {
  SceneBuilder builder("thrown_rope");
  Vec3 end = Vec3::Zero();
  int last = kWorld;
  for (int link = 0; link < 8; ++link) {
    const double angle = link % 2 == 0 ? 0.9 : -0.9;  // folded
    const Vec3 next = end + 0.25 * Vec3{std::cos(angle), std::sin(angle), 0.0};
    const int rod = add_rod(builder, end, next, 0.05);
    builder.add_ball_joint(rod, last, end);
    last = rod;
    end = next;
  }
  const int ball = builder.add_body(Sphere{0.1}, 5.0, end + Vec3{0.1, 0.0, 0.0});
  builder.body(ball).velocity = {-1.0, 3.0, 0.0};
  builder.add_ball_joint(ball, last, end);
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  builder.scene().criteria.track = ball;
  Scene scene = *builder.build();
  scene.effects.contact = scene.effects.friction = scene.effects.restitution = false;
  return scene;
}

/// Boxes on ball joints at their corners, thrown in space.
Scene chain_in_space(const Vec3& half, int count) {
  SceneBuilder builder(half[0] == half[1] ? "cubes_in_space" : "boxes_in_space");
  std::mt19937_64 random(7);
  const auto number = [&random] {
    return 2.0 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1.0;
  };
  Vec3 joint = Vec3::Zero();
  int last = kWorld;
  for (int i = 0; i < count; ++i) {
    const int box = builder.add_body(Box{half}, 1.0 + 0.5 * i, joint + half);
    builder.add_ball_joint(box, last, joint);
    builder.body(box).velocity = {3.0 * number(), 3.0 * number(), 3.0 * number()};
    builder.body(box).angular_velocity = {8.0 * number(), 8.0 * number(), 8.0 * number()};
    joint += 2.0 * half;
    last = box;
  }
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  builder.scene().criteria.track = last;
  Scene scene = *builder.build();
  scene.effects.contact = scene.effects.friction = scene.effects.restitution = false;
  return scene;
}

/// A crank of 20 rad/s, a connecting rod and a slider in a guide.
Scene slider_crank() {
  SceneBuilder builder("slider_crank");
  const Vec3 crank_end{0.0, 0.3, 0.0};
  const Vec3 pin{std::sqrt(1.0 - 0.09), 0.0, 0.0};
  const int crank = add_rod(builder, kOrigin, crank_end, 0.5);
  const int rod = add_rod(builder, crank_end, pin, 1.0);
  const int slider = builder.add_body(Box{{0.1, 0.05, 0.05}}, 2.0, pin);
  spin(builder.body(crank), kOrigin, {0.0, 0.0, 20.0});
  builder.add_hinge(crank, kWorld, kOrigin, Vec3::UnitZ());
  builder.add_hinge(rod, crank, crank_end, Vec3::UnitZ());
  builder.add_hinge(rod, slider, pin, Vec3::UnitZ());
  builder.add_prismatic(slider, kWorld, pin, Vec3::UnitX());
  builder.scene().criteria.track = slider;
  builder.scene().gravity = {0.0, -kGravity, 0.0};
  return *builder.build();
}

const Quat kTurn = Quat{0.3, -0.5, 0.7, 0.4}.normalized();

std::vector<Scene> mechanisms() {
  Scene bricard = scenes::exam_bricard().scene;
  return {crank_rocker(Quat::Identity()),
          crank_rocker(kTurn),
          thrown_rope(),
          chain_in_space({0.2, 0.2, 0.2}, 6),
          chain_in_space({0.3, 0.15, 0.05}, 6),
          slider_crank(),
          scenes::whirling_chain(),
          std::move(bricard)};
}

struct Energies {
  double scale = 0.0;   // largest kinetic energy [J]
  double rise = 0.0;    // above the lowest so far [J]
  double change = 0.0;  // largest, from the start [J]
  double gap = 0.0;     // of a joint [m]
  int most = 0;         // sub-steps
  int again = 0;        // frames taken again
};

Energies energies_of_run(const Scene& scene, const Settings& settings, double seconds) {
  Energies out;
  double start = 0.0;
  double lowest = 0.0;
  const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
    if (report.frame == 1) start = lowest = report.energy;
    lowest = std::min(lowest, report.energy);
    keep_largest(out.scale, report.kinetic);
    keep_largest(out.rise, report.energy - lowest);
    keep_largest(out.change, std::abs(report.energy - start));
    keep_largest(out.gap, report.joint_gap);
    out.most = std::max(out.most, report.n_substeps);
    if (report.attempts > 1) ++out.again;
    EXPECT_EQ(report.status, StepStatus::kOk) << scene.name;
  };
  const std::size_t frames = run(scene, settings, seconds, every, false).n.size();
  EXPECT_EQ(frames, static_cast<std::size_t>(seconds / scene.frame + 0.5)) << scene.name;
  return out;
}

TEST(Steady, KeepsTheEnergyOfMechanisms) {
  for (const Scene& scene : mechanisms()) {
    for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kEuler}) {
      for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
        SCOPED_TRACE(scene.name + " " + std::string(name_of(integrator)) + " " +
                     std::string(name_of(policy)));
        Settings settings = steady();
        settings.integrator = integrator;
        settings.policy = policy;
        const Energies e = energies_of_run(scene, settings, 20.0);
        // Euler applies forces over the new length when N changes, an error of first order.
        const double share = integrator == Integrator::kEuler ? 0.03 : 0.01;
        EXPECT_LT(e.rise, share * e.scale);
        EXPECT_LT(e.change, 2.0 * share * e.scale);
        EXPECT_LT(e.gap, 1e-10);
      }
    }
  }
}

// A smaller alpha is no cure.
TEST(Steady, ThePapersRuleGainsEnergyAtEveryAlpha) {
  for (const Scene& scene :
       {crank_rocker(Quat::Identity()), thrown_rope(), chain_in_space({0.2, 0.2, 0.2}, 6)}) {
    SCOPED_TRACE(scene.name);
    for (const double alpha : {0.1, 0.05, 0.025}) {
      Settings settings;
      settings.alpha = alpha;
      const Energies e = energies_of_run(scene, settings, 10.0);
      EXPECT_GT(e.rise, 0.1 * e.scale) << alpha;
    }
  }
}

// No scene here states a limit.
TEST(Steady, AVerdictNeedsNoLimitsOfTheScene) {
  for (const Scene& scene :
       {crank_rocker(Quat::Identity()), thrown_rope(), chain_in_space({0.2, 0.2, 0.2}, 6)}) {
    SCOPED_TRACE(scene.name);
    const std::string paper = run(scene, Settings{}, 10.0).verdict;
    EXPECT_NE(paper.find("energy gain"), std::string::npos) << paper;
    EXPECT_EQ(run(scene, steady(), 10.0).verdict, "holds");
  }
  const Scene torn = chain_in_space({0.2, 0.2, 0.2}, 6);
  const Settings loose{.solver = SolverKind::kPgs, .iterations = 1, .mode = Mode::kNone};
  const std::string verdict = run(torn, loose, 10.0).verdict;
  EXPECT_NE(verdict.find("joint gap"), std::string::npos) << verdict;
}

TEST(Steady, NeedsExactJointsAndTheHold) {
  const Scene scene = crank_rocker(Quat::Identity());
  Settings drifts = steady();
  drifts.drift = Drift::kFull;
  EXPECT_GT(energies_of_run(scene, drifts, 20.0).change, 0.1 * 100.0);
  Settings follows = steady();
  follows.hold = 1;
  EXPECT_GT(energies_of_run(scene, follows, 20.0).change, 0.02 * 100.0);
}

TEST(Steady, TakesAFrameAgainOnlyWhereNWasTooSmall) {
  const Energies e = energies_of_run(thrown_rope(), steady(), 5.0);
  EXPECT_GT(e.again, 1);
  EXPECT_LT(e.again, 60);
  EXPECT_GT(e.most, 30);
}

TEST(Steady, AFrameTakenAgainIsOneOfMoreSubsteps) {
  const auto scene = shared(thrown_rope());
  Simulator simulator = simulator_of(scene, steady());
  int again = 0;
  for (int i = 0; i < 120; ++i) {
    const State before = simulator.state();
    const FrameReport report = simulator.step();
    if (report.attempts == 1) continue;
    ++again;
    EXPECT_EQ(report.work.solves, report.n_substeps + report.n_discarded);
    Settings fixed = steady();
    fixed.mode = Mode::kConst;
    fixed.n = report.n_substeps;
    Simulator other = simulator_of(scene, fixed);
    other.set_state(before);
    other.step();
    EXPECT_EQ(state_hash(simulator.state()), state_hash(other.state())) << i;
  }
  EXPECT_GT(again, 0);
}

// Second order in the sub-step: N is proportional to alpha^-1/2.
TEST(Steady, IsSecondOrder) {
  for (const Scene& scene : {crank_rocker(kTurn), chain_in_space({0.3, 0.15, 0.05}, 4)}) {
    SCOPED_TRACE(scene.name);
    const auto end = [&](double alpha) {
      Settings settings = steady();
      settings.alpha = alpha;
      settings.n_max = 4000;
      const Outcome outcome = run(scene, settings, 1.0);
      EXPECT_EQ(outcome.n.size(), 60U) << outcome.verdict;
      EXPECT_LT(outcome.n_max(), settings.n_max);
      return outcome.track.back();
    };
    const Vec3 finest = end(0.1 / 1024.0);
    double before = (end(0.1) - finest).norm();
    for (const double alpha : {0.025, 0.1 / 16.0, 0.1 / 64.0}) {
      const double now = (end(alpha) - finest).norm();
      EXPECT_LT(now, before / 3.0) << alpha;
      before = now;
    }
  }
}

TEST(Steady, ContinuesFromASnapshotAndAFileBitForBit) {
  for (const bool islands : {false, true}) {
    Settings settings = steady();
    settings.islands = islands;
    settings.hold = 10;
    const auto scene = shared(thrown_rope());
    Simulator whole = simulator_of(scene, settings);
    for (int i = 0; i < 40; ++i) whole.step();
    expect_continues(whole, 120);
  }
}

TEST(Steady, InPartsIsTheSameBitForBit) {
  const auto scene = shared(thrown_rope());
  Simulator whole = simulator_of(scene, steady());
  Simulator by_substep = simulator_of(scene, steady());
  Simulator by_work = simulator_of(scene, steady());
  int again = 0;
  for (int i = 0; i < 120; ++i) {
    const FrameReport report = whole.step();
    if (report.attempts > 1) ++again;
    FrameReport part = by_substep.substep();
    while (by_substep.substeps_left() > 0) part = by_substep.substep();
    EXPECT_EQ(part.work.flops, report.work.flops);
    by_work.step_some(1.0);
    while (by_work.substeps_left() > 0) by_work.step_some(1.0);
    ASSERT_EQ(state_hash(whole.state()), state_hash(by_substep.state())) << i;
    ASSERT_EQ(state_hash(whole.state()), state_hash(by_work.state())) << i;
  }
  EXPECT_GT(again, 0);
}

// Closing a joint must not push a body into a contact: both are solved together. An arm on a box
// topples onto a floor.
TEST(Steady, ExactJointsAndContactsHoldTogether) {
  SceneBuilder builder("on_the_floor");
  builder.add_fixed(Box{{5.0, 0.5, 5.0}}, {0.0, -0.5, 0.0});
  const int box = builder.add_body(Box{{0.5, 0.1, 0.3}}, 1.0, {0.0, 0.1, 0.0});
  const int arm = builder.add_body(Box{{0.1, 0.5, 0.1}}, 5.0, {0.6, 0.7, 0.0});
  builder.add_hinge(arm, box, {0.5, 0.2, 0.0}, {0.1, 0.2, 1.0});
  builder.body(arm).angular_velocity = {0.0, 0.0, -3.0};
  const Scene scene = *builder.build();
  const auto largest = [&](Drift drift) {
    Settings settings = steady();
    settings.drift = drift;
    settings.detection = Detection::kSubstep;
    std::pair<double, double> most{0.0, 0.0};  // gap of the joint, overlap [m]
    int touching = 0;
    const EveryFrame every = [&](const Simulator&, const FrameReport& report) {
      EXPECT_EQ(report.status, StepStatus::kOk);
      keep_largest(most.first, report.joint_gap);
      keep_largest(most.second, report.penetration);
      if (report.contact_rows > 0) ++touching;
    };
    EXPECT_EQ(run(scene, settings, 3.0, every, false).n.size(), 180U);
    EXPECT_GT(touching, 100);
    return most;
  };
  const auto [gap, overlap] = largest(Drift::kExact);
  const auto [full_gap, full_overlap] = largest(Drift::kFull);
  EXPECT_LT(gap, 1e-12);
  EXPECT_GT(full_gap, 1e-6);
  EXPECT_LT(overlap, 1.1 * full_overlap);
}

// Without joints there is nothing to close: contacts, rigid or springs, are those of the full law.
TEST(Steady, ContactsAreThoseOfTheFullLaw) {
  for (const double compliance : {0.0, 1e-10, 1e-4}) {
    SceneBuilder builder("pair");
    builder.add_fixed(Box{{5.0, 0.5, 5.0}}, {0.0, -0.5, 0.0});
    builder.add_body(Box{{0.3, 0.1, 0.2}}, 1.0, {0.0, 0.4, 0.0});
    builder.add_body(Sphere{0.1}, 3.0, {0.1, 1.0, 0.05});
    builder.scene().contact.compliance = compliance;
    const Scene scene = *builder.build();
    Settings full = steady();
    full.drift = Drift::kFull;
    EXPECT_EQ(state_hash(run(scene, steady(), 2.0).end), state_hash(run(scene, full, 2.0).end))
        << compliance;
  }
}

}  // namespace
}  // namespace substep::test
