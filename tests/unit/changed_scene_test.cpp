// Bodies and joints are added and removed while a scene runs.

#include "core/sim/changed_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "core/collision/contact_point.hpp"
#include "core/constraints/coordinate_stage.hpp"
#include "core/math/random.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/sanitized.hpp"

namespace substep::test {
namespace {

/// A running scene that is edited, and names for what is added.
class Workshop {
 public:
  Workshop(Scene scene, const substep::Settings& settings)
      : scene_(std::move(scene)), simulator_(begun(scene_, settings)) {}

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const State& state() const { return simulator_.state(); }
  FrameReport step() { return simulator_.step(); }

  /// Applies an edit of the scene, which may refer to the current state.
  template <class Edit>
  void change(Edit&& edit) {
    Scene changed = scene_;
    edit(changed);
    const Kept kept = kept_by_name(scene_, changed);
    const Scene goes_on = continue_with(changed, scene_, simulator_.state(), kept);
    ASSERT_FALSE(goes_on.bodies.empty());
    const std::int64_t frame = simulator_.state().frame;
    const double time = simulator_.state().time;
    simulator_ = begun(goes_on, simulator_.settings());
    ASSERT_TRUE(simulator_.problems().empty()) << simulator_.problems().front().message;
    State state = simulator_.state();
    state.frame = frame;
    state.time = time;
    simulator_.set_state(state);
    // Poses and velocities of the scene before stand for an unchanged start.
    scene_ = goes_on;
  }

  [[nodiscard]] int find(const std::string& name) const {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (scene_.bodies[i].name == name) return static_cast<int>(i);
    }
    return -1;
  }

 private:
  static Simulator begun(const Scene& scene, const substep::Settings& settings) {
    Simulator simulator(std::make_shared<const Scene>(scene));
    simulator.set_settings(settings);
    return simulator;
  }

  Scene scene_;
  Simulator simulator_;
};

void remove_body(Scene& scene, int body) {
  std::erase_if(scene.joints,
                [&](const Joint& joint) { return base(joint).a == body || base(joint).b == body; });
  for (Joint& joint : scene.joints) {
    for (int* end : {&base(joint).a, &base(joint).b}) {
      if (*end > body) --*end;
    }
  }
  scene.bodies.erase(scene.bodies.begin() + body);
}

/// A ball joint between two bodies, half way between their centres.
BallJoint joint_between(const Workshop& shop, int a, int b, const std::string& name) {
  const State& now = shop.state();
  const Vec3 point = 0.5 * (now.x[index(a)] + now.x[index(b)]);
  BallJoint joint;
  joint.name = name;
  joint.a = a;
  joint.b = b;
  joint.anchor_a = now.q[index(a)].conjugate() * (point - now.x[index(a)]);
  joint.anchor_b = now.q[index(b)].conjugate() * (point - now.x[index(b)]);
  return joint;
}

Body ball_of(const std::string& name, const Vec3& position) {
  SceneBuilder builder("ball");
  builder.add_body(Sphere{0.2}, 1.0, position);
  Body ball = builder.build()->bodies.front();
  ball.name = name;
  ball.friction = 0.4;
  return ball;
}

/// Random edits of bodies whose names do not begin with "kept".
class Editor {
 public:
  /// @return whether it changed anything
  bool edit(Workshop& shop) {
    std::vector<int> mine;
    for (std::size_t i = 0; i < shop.scene().bodies.size(); ++i) {
      if (!shop.scene().bodies[i].name.starts_with("kept")) mine.push_back(static_cast<int>(i));
    }
    const auto any = [&] { return mine[index(below(static_cast<int>(mine.size())))]; };
    const std::string name = "added" + std::to_string(++names_);
    const int choice = below(12);
    if (choice == 0 && mine.size() < 12) {
      // Anywhere in the list: the places of others change.
      const int at = below(static_cast<int>(shop.scene().bodies.size()) + 1);
      const Vec3 position{3.0 * random_.next(), 2.0 + random_.next(), 0.0};
      shop.change([&](Scene& now) {
        now.bodies.insert(now.bodies.begin() + at, ball_of(name, position));
        for (Joint& joint : now.joints) {
          for (int* end : {&base(joint).a, &base(joint).b}) {
            if (*end >= at) ++*end;
          }
        }
      });
      return true;
    }
    if (choice == 1 && mine.size() > 2) {
      shop.change([&](Scene& now) { remove_body(now, any()); });
      return true;
    }
    if (choice == 2 && mine.size() > 2) {
      const int a = any();
      const int b = any();
      if (a == b) return false;
      shop.change([&](Scene& now) { now.joints.push_back(joint_between(shop, a, b, name)); });
      return true;
    }
    if (choice != 3) return false;
    shop.change([&](Scene& now) {
      const auto joint = std::find_if(now.joints.begin(), now.joints.end(), [](const Joint& j) {
        return base(j).name.starts_with("added");
      });
      if (joint != now.joints.end()) now.joints.erase(joint);
    });
    return true;
  }

 private:
  int below(int n) { return static_cast<int>(0.5 * (random_.next() + 1.0) * n); }

  substep::Random random_{7};
  int names_ = 0;
};

// ------------------------------------------------------------------------------ untouched islands
/// On a floor: three bodies to edit, and islands that no edit touches: a chain of unequal
/// links, a stack that lands, a hinge with limit and motor, a slide on a spring.
Scene islands() {
  SceneBuilder builder("islands");
  builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = 0.5;
  for (int i = 0; i < 3; ++i) {
    builder.body(builder.add_body(Sphere{0.2}, 1.0, {2.0 * i, 0.5, 0.0})).friction = 0.4;
  }
  int above = kWorld;
  for (int i = 0; i < 4; ++i) {
    const int link = builder.add_body(Box{{0.25, 0.05, 0.08}}, 1.0 + i, {-20.25 - 0.5 * i, 6, 0});
    builder.add_ball_joint(link, above, {-20.0 - 0.5 * i, 6.0, 0.0});
    above = link;
  }
  for (int i = 0; i < 3; ++i) {
    const int box = builder.add_body(Box{{0.5, 0.3, 0.4}}, 2.0, {-12, 0.35 + 0.65 * i, 0.05 * i});
    builder.body(box).friction = 0.5;
  }
  const int arm = builder.add_body(Box{{0.5, 0.1, 0.1}}, 1.0, {-29.5, 5.0, 0.0});
  const int hinge = builder.add_hinge(arm, kWorld, {-30.0, 5.0, 0.0}, Vec3::UnitZ());
  const int slider = builder.add_body(Box{{0.1, 0.1, 0.1}}, 1.0, {-35.0, 5.0, 0.0});
  const int slide = builder.add_prismatic(slider, kWorld, {-35.0, 5.0, 0.0}, Vec3::UnitY());
  Scene scene = *builder.build();
  auto& swinging = std::get<HingeJoint>(scene.joints[index(hinge)]);
  swinging.limit = AngleLimit{{-0.7, 0.7, 0.5}, {}};
  swinging.motor = AngularMotor{{2.0, 3.0}};
  auto& sprung = std::get<PrismaticJoint>(scene.joints[index(slide)]);
  sprung.spring = LinearSpring{{0.0, 100.0, 0.5}};
  scene.effects.limits = scene.effects.motors = scene.effects.springs = true;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene.bodies[i].name = (i >= 1 && i <= 3 ? "edited" : "kept") + std::to_string(i);
  }
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    base(scene.joints[i]).name = "kept_joint" + std::to_string(i);
  }
  return scene;
}

struct Method {
  const char* name;
  substep::Settings settings;
  friend void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }
};

/// Those that end a sub-step after a fixed number of operations. Others end it when the slowest
/// island is solved.
std::vector<Method> methods() {
  substep::Settings paper = kPaperSettings;
  paper.mode = Mode::kConst;
  paper.n = 8;
  substep::Settings leapfrog = paper;
  leapfrog.integrator = Integrator::kLeapfrog;
  substep::Settings xpbd = paper;
  xpbd.solver = SolverKind::kXpbd;
  return {{"paper", paper}, {"leapfrog", leapfrog}, {"xpbd", xpbd}};
}

class Changes : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(ChangedScene, Changes, testing::ValuesIn(methods()),
                         [](const auto& method) { return method.param.name; });

TEST_P(Changes, LeaveOtherIslandsOfJointsBitForBit) {
  Scene scene = islands();
  scene.effects.contact = scene.effects.friction = false;
  Workshop shop(scene, GetParam().settings);
  Workshop untouched(scene, GetParam().settings);
  Editor editor;
  int changes = 0;
  const int frames = repetitions(2000, 100);
  for (int frame = 0; frame < frames; ++frame) {
    if (editor.edit(shop)) ++changes;
    ASSERT_EQ(shop.step().status, StepStatus::kOk) << frame;
    ASSERT_EQ(untouched.step().status, StepStatus::kOk) << frame;
    for (const Body& body : scene.bodies) {
      if (!body.name.starts_with("kept")) continue;
      const auto i = index(shop.find(body.name));
      const auto j = index(untouched.find(body.name));
      ASSERT_EQ(shop.state().x[i], untouched.state().x[j]) << body.name << ", frame " << frame;
      ASSERT_EQ(shop.state().u[i], untouched.state().u[j]) << body.name << ", frame " << frame;
      ASSERT_EQ(shop.state().q[i].coeffs(), untouched.state().q[j].coeffs()) << body.name;
    }
  }
  EXPECT_GT(changes, frames / 6);
}

// The stack, once it rests, stays where it is: while N changes with what moves beside it, friction
// creeps by 2e-9 m a frame.
TEST(ChangedScene, HoldsThroughManyChanges) {
  substep::Settings sleeping;
  sleeping.islands = sleeping.sleep = true;
  for (const substep::Settings& settings : {substep::Settings{}, sleeping}) {
    Workshop shop(islands(), settings);
    Editor editor;
    Vec3 rests = Vec3::Zero();
    for (int frame = 0; frame < repetitions(2500, 150); ++frame) {
      editor.edit(shop);
      const FrameReport report = shop.step();
      ASSERT_EQ(report.status, StepStatus::kOk) << frame;
      ASSERT_LT(report.joint_gap, 1e-10) << frame;
      const Vec3 top = shop.state().x[index(shop.find("kept10"))];
      if (frame == 120) rests = top;
      if (frame > 120) {
        ASSERT_LT((top - rests).norm(), 1e-4) << frame;
      }
    }
  }
}

// ------------------------------------------------------------------------------ what is carried
TEST(ChangedScene, CarriesTheForcesOfContactsAndLimitsUnderTheirNewNumbers) {
  Workshop shop(islands(), substep::Settings{});
  for (int frame = 0; frame < 90; ++frame) shop.step();
  const Scene before = shop.scene();
  const State state = shop.state();
  Scene changed = before;
  changed.bodies.insert(changed.bodies.begin(), ball_of("new", {0.0, 9.0, 9.0}));
  for (Joint& joint : changed.joints) {
    for (int* end : {&base(joint).a, &base(joint).b}) {
      if (*end >= 0) ++*end;
    }
  }
  std::swap(changed.joints.front(), changed.joints.back());
  const Kept kept = kept_by_name(before, changed);
  const Scene goes_on = continue_with(changed, before, state, kept);
  ASSERT_TRUE(goes_on.carried.has_value());
  int contacts = 0;
  int coordinates = 0;
  ASSERT_EQ(goes_on.carried->forces.size(), state.forces.size());
  for (std::size_t i = 0; i < state.forces.size(); ++i) {
    const std::uint64_t was = state.forces[i].id;
    const std::uint64_t now = goes_on.carried->forces[i].id;
    if (is_contact_id(was)) {
      ++contacts;
      const auto [a, b] = bodies_of_contact(was);
      EXPECT_EQ(bodies_of_contact(now), std::pair(a + 1, b + 1));
      EXPECT_EQ(feature_of_contact(now), feature_of_contact(was));
    } else if (CoordinateStage::is_id(was)) {
      ++coordinates;
      EXPECT_EQ(CoordinateStage::acts(now), CoordinateStage::acts(was));
      EXPECT_EQ(kept.joints[index(CoordinateStage::joint_of(now))], CoordinateStage::joint_of(was));
    } else {
      EXPECT_EQ(kept.joints[now], static_cast<int>(was));
    }
    EXPECT_EQ(goes_on.carried->forces[i].lambda[0], state.forces[i].lambda[0]);
  }
  EXPECT_GE(contacts, 8);
  EXPECT_GE(coordinates, 2);
  // Another shape has other features.
  changed.bodies[11].shape = Sphere{0.3};
  const Scene reshaped = continue_with(changed, before, state, kept_by_name(before, changed));
  EXPECT_LT(reshaped.carried->forces.size(), state.forces.size());
  changed.bodies[11].shape = before.bodies[10].shape;
  // The pair in the other order too.
  std::swap(changed.bodies[9], changed.bodies[10]);
  const Scene turned = continue_with(changed, before, state, kept_by_name(before, changed));
  EXPECT_LT(turned.carried->forces.size(), state.forces.size());
}

TEST(ChangedScene, ASleepingBodyFallsWhenItsSupportIsRemoved) {
  SceneBuilder builder("tower");
  builder.add_fixed(Plane{}, Vec3::Zero());
  for (int i = 0; i < 2; ++i) builder.add_body(Box{{0.5, 0.5, 0.5}}, 1.0, {0.0, 0.5 + i, 0.0});
  Scene scene = *builder.build();
  for (std::size_t i = 0; i < 3; ++i) scene.bodies[i].name = "body" + std::to_string(i);
  substep::Settings sleeping;
  sleeping.islands = sleeping.sleep = true;
  Workshop shop(scene, sleeping);
  FrameReport report;
  for (int frame = 0; frame < 120; ++frame) report = shop.step();
  ASSERT_EQ(report.asleep, 2);
  shop.change([](Scene& now) { remove_body(now, 1); });
  for (int frame = 0; frame < 60; ++frame) shop.step();
  EXPECT_NEAR(shop.state().x[1].y(), 0.5, 1e-5);
}

TEST(ChangedScene, AReleasedBodyFliesOnAParabola) {
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    SceneBuilder builder("pendulum");
    const int ball = builder.add_body(Sphere{0.1}, 1.0, {1.0, 0.0, 0.0});
    builder.add_hinge(ball, kWorld, Vec3::Zero(), Vec3::UnitZ());
    Scene scene = *builder.build();
    scene.bodies[0].name = "ball";
    substep::Settings settings;
    settings.integrator = integrator;
    Workshop shop(scene, settings);
    for (int frame = 0; frame < 40; ++frame) shop.step();
    const Vec3 x = shop.state().x[0];
    const Vec3 v = shop.state().u_synchronised[0].head<3>();
    ASSERT_GT(v.norm(), 1.0);
    shop.change([](Scene& now) { now.joints.clear(); });
    for (int frame = 0; frame < 30; ++frame) shop.step();
    const double t = 30.0 * scene.frame;
    const Vec3 exact = x + t * v + 0.5 * t * t * scene.gravity;
    EXPECT_LT((shop.state().x[0] - exact).norm(), 1e-12) << name_of(integrator);
  }
}

TEST(ChangedScene, AConnectionKeepsTheMomenta) {
  SceneBuilder builder("pair");
  builder.add_body(Box{{0.2, 0.3, 0.1}}, 2.0, {0.0, 0.0, 0.0});
  builder.add_body(Box{{0.1, 0.1, 0.3}}, 0.7, {0.5, 0.4, 0.2});
  Scene scene = *builder.build();
  scene.gravity.setZero();
  scene.bodies[0].name = "a";
  scene.bodies[1].name = "b";
  scene.bodies[0].velocity = {0.3, 0.1, -0.2};
  scene.bodies[0].angular_velocity = {1.0, -0.4, 0.3};
  scene.bodies[1].velocity = {-0.4, 0.2, 0.5};
  Workshop shop(scene, substep::Settings{});
  for (int frame = 0; frame < 5; ++frame) shop.step();
  const auto momenta = [&] {
    Vec6 sum = Vec6::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      const Body& body = shop.scene().bodies[i];
      const Vec6& u = shop.state().u_synchronised[i];
      const Mat3 R = shop.state().q[i].toRotationMatrix();
      const Vec3 p = body.mass * u.head<3>();
      sum.head<3>() += p;
      sum.tail<3>() += shop.state().x[i].cross(p) +
                       R * body.inertia.cwiseProduct(R.transpose() * Vec3(u.tail<3>()));
    }
    return sum;
  };
  const Vec6 before = momenta();
  shop.change([&](Scene& now) { now.joints.push_back(joint_between(shop, 0, 1, "new")); });
  for (int frame = 0; frame < 60; ++frame) {
    const FrameReport report = shop.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    ASSERT_LT(report.joint_gap, 1e-12);
  }
  EXPECT_LT((momenta() - before).norm(), 1e-9);
}

TEST(ChangedScene, AStartThatWasChangedIsTaken) {
  Workshop shop(islands(), substep::Settings{});
  for (int frame = 0; frame < 20; ++frame) shop.step();
  const State before = shop.state();
  const auto edited = index(shop.find("edited2"));
  const Vec3 place{1.0, 4.0, 2.0};
  shop.change([&](Scene& now) { now.bodies[edited].position = place; });
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    EXPECT_EQ(shop.state().x[i], i == edited ? place : before.x[i]) << i;
    EXPECT_EQ(shop.state().u_synchronised[i], before.u_synchronised[i]) << i;
  }
  shop.change([&](Scene& now) { now.bodies[edited].velocity = place; });
  EXPECT_EQ(shop.state().u_synchronised[edited].head<3>(), place);
  EXPECT_EQ(shop.state().x[edited], place);
}

TEST(ChangedScene, WhatDoesNotFitIsRefused) {
  const Scene scene = islands();
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.step();
  const State& state = simulator.state();
  const Kept all = kept_by_name(scene, scene);
  EXPECT_FALSE(continue_with(scene, scene, state, all).bodies.empty());
  Kept twice = all;
  twice.bodies[1] = 0;
  EXPECT_TRUE(continue_with(scene, scene, state, twice).bodies.empty());
  Kept beyond = all;
  beyond.joints[0] = 99;
  EXPECT_TRUE(continue_with(scene, scene, state, beyond).bodies.empty());
  Kept fewer = all;
  fewer.bodies.pop_back();
  EXPECT_TRUE(continue_with(scene, scene, state, fewer).bodies.empty());
  EXPECT_TRUE(continue_with(Scene{}, Scene{}, state, {}).bodies.empty());
}

TEST(ChangedScene, NamesThatOccurTwiceAreNew) {
  Scene scene = islands();
  scene.bodies[2].name = scene.bodies[1].name;
  const Kept kept = kept_by_name(scene, scene);
  EXPECT_EQ(kept.bodies[1], -1);
  EXPECT_EQ(kept.bodies[2], -1);
  EXPECT_EQ(kept.bodies[3], 3);
  Scene other = islands();
  base(other.joints[0]).anchor_a.x() += 0.1;
  EXPECT_EQ(kept_by_name(islands(), other).joints[0], -1) << "another joint of that name";
  Scene held = islands();  // the joint with the world holds a new body now
  held.bodies.push_back(ball_of("new", {-20.0, 6.0, 0.0}));
  base(held.joints[0]).b = static_cast<int>(held.bodies.size()) - 1;
  EXPECT_EQ(kept_by_name(islands(), held).joints[0], -1);
}

}  // namespace
}  // namespace substep::test
