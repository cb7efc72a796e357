// Verdicts of scenes that state no limits: forty runs that are broken fail for the right reason,
// and correct ones hold, soft ones too. Small worlds, in a plane and in space.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/presets.hpp"
#include "core/lab/start_text.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene_builder.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

using What = Exceeded::What;

Settings ours() { return substep::Settings{}; }

Settings fixed_n(int n, Settings settings = {}) {
  settings.mode = Mode::kConst;
  settings.n = n;
  return settings;
}

/// The same scene without its criteria: the default limits apply.
Scene without_limits(Scene scene) {
  scene.criteria.joint_gap.reset();
  scene.criteria.energy_gain.reset();
  scene.criteria.displacement.reset();
  return scene;
}

const Shape kSmallBall = Sphere{0.1};
const Shape kSmallCube = Box{{0.1, 0.1, 0.1}};

/// A ball or a cube falls onto a floor.
Scene dropped(const Shape& shape, double height, double e = 0.0) {
  SceneBuilder builder("drop");
  builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).name = "floor";
  const int body = builder.add_body(shape, 1.0, {0.0, height + 0.1, 0.0});
  builder.body(body).name = "falling";
  builder.body(body).restitution = e;
  return *builder.build();
}

/// Something is thrown along x at a wall of 0.1 m, without gravity. @param across offset along y
/// [m]
Scene thrown(const Shape& shape, double speed, double across = 0.0) {
  SceneBuilder builder("shot");
  builder.body(builder.add_fixed(Box{{0.05, 1.0, 1.0}}, Vec3::Zero())).name = "wall";
  const int body = builder.add_body(shape, 1.0, {-1.6, across, 0.0});
  builder.body(body).name = "bullet";
  builder.body(body).velocity = {speed, 0.0, 0.0};
  builder.scene().effects.gravity = false;
  return *builder.build();
}

/// Two balls fly through each other's place.
Scene crossing() {
  Scene scene = thrown(kSmallBall, 60.0);
  scene.bodies[0] = scene.bodies[1];
  scene.bodies[0].name = "other";
  scene.bodies[0].position = {0.9, 0.02, 0.0};
  scene.bodies[0].velocity = {-50.0, 0.0, 0.0};
  return scene;
}

/// A bar turns about its middle like a propeller; a ball rests in its way.
Scene propeller(double rate) {
  SceneBuilder builder("propeller");
  const int bar = builder.add_body(Box{{1.0, 0.03, 0.03}}, 5.0, Vec3::Zero());
  builder.body(bar).angular_velocity = {0.0, 0.0, rate};
  const int ball = builder.add_body(Sphere{0.04}, 0.1, {0.5, 0.15, 0.0});
  builder.body(ball).name = "fly";
  builder.scene().effects.gravity = false;
  return *builder.build();
}

/// Boxes or balls on each other, the upper ones heavier. @param overlap of neighbours [m]
Scene tower(int count, double ratio, double overlap = 0.0) {
  SceneBuilder builder("tower");
  builder.add_fixed(Plane{}, Vec3::Zero());
  double mass = 1.0;
  for (int i = 0; i < count; ++i, mass *= ratio) {
    builder.add_body(kSmallCube, mass, {0.0, 0.1 + i * (0.2 - overlap), 0.0});
  }
  return *builder.build();
}

/// A rod of 1 m on a ball joint, with a spin. @param compliance of the joint [m/N]
Scene gyrating(double compliance) {
  SceneBuilder builder("gyrating");
  const int rod = builder.add_body(Box{{0.5, 0.1, 0.05}}, 2.0, {0.5, 0.0, 0.0});
  builder.body(rod).angular_velocity = {3.0, 2.0, 0.0};
  builder.body(rod).velocity = builder.body(rod).angular_velocity.cross(Vec3{0.5, 0.0, 0.0});
  BallJoint joint;
  joint.name = "pivot";
  joint.a = rod;
  joint.anchor_a = {-0.5, 0.0, 0.0};
  joint.compliance = compliance;
  builder.scene().joints.emplace_back(joint);
  return *builder.build();
}

Scene with_spin(Scene scene, const Vec3& omega) {
  for (Body& body : scene.bodies) body.angular_velocity = omega;
  return scene;
}

Scene rope(int n, double mass) {
  return without_limits(scenes::rope_of_n({.n = n, .end_mass = mass}));
}

struct Broken {
  std::string what;
  Scene scene;
  Settings settings;
  std::vector<What> reasons;  // any of them; none: it cannot continue
  double seconds = 5.0;
};

std::vector<Broken> broken() {
  const Settings paper;
  const auto with = [&](auto change) {
    Settings settings;
    change(settings);
    return settings;
  };
  const auto alpha = [&](double value) { return with([&](Settings& s) { s.alpha = value; }); };
  const auto pgs = [&](int n) {
    return fixed_n(n, with([](Settings& s) { s.solver = SolverKind::kPgs; }));
  };
  const auto xpbd = [&](int n) {
    return fixed_n(n, with([](Settings& s) { s.solver = SolverKind::kXpbd; }));
  };
  const std::vector<What> gain{What::kEnergyGain};
  const std::vector<What> gap{What::kJointGap};
  const std::vector<What> overlap{What::kOverlap};
  const std::vector<What> passage{What::kPassage};
  const std::vector<What> sinks{What::kOverlap, What::kEnergyGain};
  const std::vector<What> tears{What::kJointGap, What::kEnergyGain};
  const Scene crank = scenes::crank_rocker();
  const Scene thrown_up = scenes::thrown_rope();
  const Scene top = scenes::spinning_top();
  std::vector<Broken> all{
      {"crank, the paper's rule", crank, paper, gain},
      {"crank, a smaller alpha", crank, alpha(0.05), gain},
      {"crank, a quarter of alpha", crank, alpha(0.025), gain},
      {"crank, leapfrog", crank, with([](Settings& s) { s.integrator = Integrator::kLeapfrog; }),
       gain},
      {"crank, per sub-step", crank, with([](Settings& s) { s.policy = Policy::kSubstep; }), gain},
      {"crank, drift order 2", crank, with([](Settings& s) { s.drift_order = 2; }), gain},
      {"rope, the paper's rule", thrown_up, paper, gain},
      {"rope, half of alpha", thrown_up, alpha(0.05), gain},
      {"rope, leapfrog", thrown_up, with([](Settings& s) { s.integrator = Integrator::kLeapfrog; }),
       gain, 10.0},
      {"top, explicit torque", without_limits(with_spin(top, {0.0, 60.0, 0.5})),
       fixed_n(1, with([](Settings& s) { s.gyroscopic = Gyroscopic::kExplicit; })), gain},
      {"faster top, explicit torque", without_limits(with_spin(top, {30.0, 20.0, 10.0})),
       fixed_n(1, with([](Settings& s) { s.gyroscopic = Gyroscopic::kExplicit; })), gain},
      {"overlapping cubes, the paper's contacts", tower(2, 1.0, 0.15), paper, gain},
      {"overlapping cubes, n 16", tower(2, 1.0, 0.15), fixed_n(16), gain},
      {"overlapping cubes, n 600", tower(2, 1.0, 0.15), fixed_n(600), gain},
      {"heavy overlapping cubes", tower(2, 100.0, 0.1), paper, gain},
      {"ball from 10 m", dropped(kSmallBall, 10.0), fixed_n(1), overlap},
      {"cube from 10 m", dropped(kSmallCube, 10.0), fixed_n(1), overlap},
      {"ball from 100 m", dropped(kSmallBall, 100.0), fixed_n(4), overlap},
      {"ball from 3 m", dropped(kSmallBall, 3.0), fixed_n(1), overlap},
      {"shot of 60 m/s", thrown(kSmallBall, 60.0), fixed_n(1), passage},
      {"shot of 300 m/s", thrown(kSmallBall, 300.0), fixed_n(4), passage},
      {"cube of 60 m/s", thrown(kSmallCube, 60.0), fixed_n(1), passage},
      {"shot off centre", thrown(kSmallBall, 60.0, 0.7), fixed_n(1), passage},
      {"two balls", crossing(), fixed_n(1), passage},
      {"propeller", propeller(40.0), fixed_n(1), passage},
      {"box and rope, one step", rope(12, 500.0), fixed_n(1), tears},
      {"box and rope, four steps", rope(25, 1000.0), fixed_n(4), tears},
      {"box and rope, sweeps", rope(12, 500.0), pgs(1), tears},
      {"box and rope, XPBD", rope(25, 1000.0), xpbd(1), tears},
      {"one sweep", rope(6, 100.0), fixed_n(1, with([](Settings& s) {
                                              s.solver = SolverKind::kPgs;
                                              s.iterations = 1;
                                            })),
       tears},
      {"bridge, one step", without_limits(scenes::bridge()), fixed_n(1), sinks},
      {"bridge, sweeps", without_limits(scenes::bridge()), pgs(1), sinks},
      {"heavy stack, sweeps", without_limits(scenes::heavy_stack()), pgs(4), sinks},
      {"heavy stack, XPBD", without_limits(scenes::heavy_stack()), xpbd(4), sinks},
      {"tall stack, sweeps", without_limits(scenes::heavy_stack_tall()), pgs(16), sinks},
      {"tower of three, sweeps", tower(3, 100.0), pgs(1), sinks},
      {"tower of three, our contacts, sweeps", tower(3, 1000.0),
       [] {
         Settings settings = ours();
         settings.solver = SolverKind::kPgs;
         return settings;
       }(),
       sinks},
      {"whirling chain, one step", without_limits(scenes::whirling_chain()), fixed_n(1), tears},
      {"swinging box, one step", without_limits(scenes::swinging_box()), fixed_n(1), tears},
      {"swinging box, five steps", without_limits(scenes::swinging_box()), fixed_n(5), tears, 10.0},
  };
  return all;
}

TEST(Verdicts, FortyBrokenRunsFailForTheRightReason) {
  const std::vector<Broken> all = broken();
  EXPECT_GE(all.size(), 40U);
  for (const Broken& b : all) {
    SCOPED_TRACE(b.what);
    const auto scene = shared(b.scene);
    Simulator simulator = simulator_of(scene, b.settings);
    Verdict verdict(*scene, simulator.state(), simulator.observe());
    const auto frames = static_cast<int>(b.seconds / scene->frame + 0.5);
    for (int i = 0; i < frames && verdict.holds(); ++i) {
      const FrameReport report = simulator.step();
      verdict.add(*scene, simulator.state(), report);
    }
    EXPECT_FALSE(verdict.holds());
    if (verdict.holds()) continue;
    EXPECT_TRUE(verdict.exceeded() && std::find(b.reasons.begin(), b.reasons.end(),
                                                verdict.exceeded()->what) != b.reasons.end())
        << verdict.text();
  }
}

struct Sound {
  std::string what;
  Scene scene;
  Settings settings = ours();
  double seconds = 5.0;
};

TEST(Verdicts, CorrectRunsHold) {
  const auto spring = [](double compliance, double mass) {
    Scene scene = rope(1, mass);
    for (Joint& joint : scene.joints) base(joint).compliance = compliance;
    return scene;
  };
  Scene soft_floor = dropped(kSmallBall, 1.0, 1.0);
  soft_floor.contact.compliance = 1e-4;
  const std::vector<Sound> all{
      {"crank", scenes::crank_rocker(), ours(), 20.0},
      {"rope", scenes::thrown_rope(), ours(), 10.0},
      {"ball from 10 m", dropped(kSmallBall, 10.0)},
      {"cube from 10 m", dropped(kSmallCube, 10.0)},
      {"elastic ball", dropped(kSmallBall, 5.0, 1.0), ours(), 10.0},
      {"half elastic ball", dropped(kSmallBall, 5.0, 0.5), ours(), 10.0},
      {"ball on a spring", soft_floor, ours(), 10.0},
      {"shot that stops", thrown(kSmallBall, 60.0)},
      {"shot of 300 m/s that stops", thrown(kSmallBall, 300.0)},
      {"shot that misses by 1 mm", thrown(kSmallBall, 60.0, 1.101)},
      {"shot that misses, the paper's contacts", thrown(kSmallBall, 60.0, 1.2), fixed_n(1)},
      {"two balls that collide", crossing()},
      {"propeller that hits", propeller(40.0)},
      {"tower", tower(4, 3.0)},
      {"tower of 1 and 100 kg", tower(2, 100.0), ours(), 20.0},
      {"overlapping cubes", tower(2, 1.0, 0.15)},
      {"heavy overlapping cubes", tower(3, 10.0, 0.1)},
      {"springs", spring(1e-3, 5.0), ours(), 20.0},
      {"stiffer springs", spring(1e-5, 5.0), ours(), 20.0},
      {"weak springs", spring(0.05, 1.0), ours(), 20.0},
      {"gyrating on a spring", gyrating(1e-4)},
      {"gyrating", gyrating(0.0)},
      {"swinging box", without_limits(scenes::swinging_box())},
      {"bridge", without_limits(scenes::bridge()), ours(), 2.0},
      {"house of cards", without_limits(scenes::card_house(3)), ours(), 2.0},
      {"top", without_limits(scenes::spinning_top())},
  };
  for (const Sound& s : all)
    EXPECT_EQ(run(s.scene, s.settings, s.seconds).verdict, "holds") << s.what;
}

TEST(Verdicts, NameWhatPassedThroughWhat) {
  const std::string text = run(thrown(kSmallBall, 60.0), fixed_n(1), 1.0).verdict;
  EXPECT_NE(text.find("passed through each other: bullet, wall"), std::string::npos) << text;
}

// The paths of bodies that go around, under or away from each other are no passages.
TEST(Verdicts, APathBesideABodyIsNoPassage) {
  for (const double across : {1.12, 1.101, -1.101}) {
    EXPECT_EQ(run(thrown(kSmallBall, 200.0, across), fixed_n(1), 1.0).verdict, "holds") << across;
  }
  Scene allowed = thrown(kSmallBall, 60.0);
  for (Body& body : allowed.bodies) body.collision_group = 1;
  EXPECT_EQ(run(allowed, fixed_n(1), 1.0).verdict, "holds") << "the pair does not collide";
}

TEST(Verdicts, TheStartNamesItsDeepestOverlap) {
  const Scene scene = tower(3, 1.0, 0.15);
  const Simulator simulator = simulator_of(scene, ours());
  EXPECT_EQ(overlap_text(scene, ours(), simulator.observe()),
            "'body_1' and 'body_2' overlap by 15 cm at the start; they are parted without speed.");
  EXPECT_NE(overlap_text(scene, Settings{}, simulator.observe()).find("adds speed"),
            std::string::npos);
  const Scene apart = tower(3, 1.0);
  EXPECT_EQ(overlap_text(apart, ours(), simulator_of(apart, ours()).observe()), "");
}

}  // namespace
}  // namespace substep::test
