// Input from code is validated before use, with the messages of the scene reader.

#include "core/model/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/sim/simulator.hpp"
#include "tests/unit/support.hpp"

namespace substep {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A crate on a floor, and a chain of two balls that hangs from the world.
Scene sound_scene() {
  Scene scene;
  scene.name = "sound";
  scene.title = "Sound";
  scene.effects = {.gravity = true, .joints = true, .contact = true, .friction = true};
  scene.bodies = {test::fixed(Plane{}), test::moving(Box{}), test::moving(Sphere{0.1}, 2.0),
                  test::moving(Sphere{0.1}, 2.0)};
  const char* names[] = {"floor", "crate", "upper", "lower"};
  const Vec3 places[] = {{0, 0, 0}, {0, 0.5, 0}, {3, 2, 0}, {3, 1, 0}};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene.bodies[i].name = names[i];
    scene.bodies[i].position = places[i];
    scene.bodies[i].friction = 0.5;
  }
  BallJoint hook;
  hook.name = "hook";
  hook.a = 2;
  hook.anchor_b = {3, 2, 0};
  HingeJoint link;
  link.name = "link";
  link.a = 3;
  link.b = 2;
  link.anchor_a = {0, 1, 0};
  scene.joints = {hook, link};
  return scene;
}

std::string texts(const Problems& problems) {
  std::string all;
  for (const Problem& problem : problems) all += to_code(problem) + "\n";
  return all;
}

struct Break {
  const char* place;
  std::function<void(Scene&)> apply;
};

HingeJoint& link_of(Scene& scene) { return std::get<HingeJoint>(scene.joints[1]); }

/// One invalid value each, which a file can have too.
std::vector<Break> breaks_of_files() {
  return {
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = 0.0; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = 1e13; }},
      {"/bodies/1/inertia/2", [](Scene& s) { s.bodies[1].inertia.z() = -1.0; }},
      {"/bodies/1/inertia",
       [](Scene& s) {
         s.bodies[1].inertia = {1, 1, 3};
       }},
      {"/bodies/2/shape/radius", [](Scene& s) { s.bodies[2].shape = Sphere{0.0}; }},
      {"/bodies/1/shape/size/0",
       [](Scene& s) {
         s.bodies[1].shape = Box{{0, 1, 1}};
       }},
      {"/bodies/1/shape/type", [](Scene& s) { s.bodies[1].shape = Plane{}; }},
      {"/bodies/1/position/1", [](Scene& s) { s.bodies[1].position.y() = 2e6; }},
      {"/bodies/1/orientation", [](Scene& s) { s.bodies[1].orientation = Quat(0.5, 0, 0, 0); }},
      {"/bodies/1/velocity/0", [](Scene& s) { s.bodies[1].velocity.x() = -1e9; }},
      {"/bodies/0/velocity", [](Scene& s) { s.bodies[0].velocity.x() = 1.0; }},
      {"/bodies/1/friction", [](Scene& s) { s.bodies[1].friction = -0.1; }},
      {"/bodies/1/restitution", [](Scene& s) { s.bodies[1].restitution = -1.0; }},
      {"/joints/0/compliance", [](Scene& s) { base(s.joints[0]).compliance = -1.0; }},
      {"/joints/0/anchor_a/0", [](Scene& s) { base(s.joints[0]).anchor_a.x() = 1e7; }},
      {"/joints/1/axis_a", [](Scene& s) { link_of(s).axis_a *= 0.5; }},
      {"/joints/1/angular_compliance", [](Scene& s) { link_of(s).angular_compliance = -1.0; }},
      {"/joints/1/b", [](Scene& s) { link_of(s).b = 3; }},
      {"/joints/0/a", [](Scene& s) { base(s.joints[0]).a = 0; }},
      {"/joints/0", [](Scene& s) { base(s.joints[0]).anchor_b.x() = 4.0; }},
      {"/joints/1", [](Scene& s) { link_of(s).axis_b = -Vec3::UnitZ(); }},
      {"/contact/compliance", [](Scene& s) { s.contact.compliance = 0.0; }},
      {"/contact/margin", [](Scene& s) { s.contact.margin = 2e6; }},
      {"/frame", [](Scene& s) { s.frame = 0.0; }},
      {"/gravity/1", [](Scene& s) { s.gravity.y() = -1e9; }},
      {"/regularisation", [](Scene& s) { s.regularisation = -1.0; }},
      {"/settings/alpha", [](Scene& s) { s.settings.alpha = 0.0; }},
      {"/settings/n", [](Scene& s) { s.settings.n = 0; }},
      {"/settings/iterations", [](Scene& s) { s.settings.iterations = 1000000; }},
      {"/criteria/duration", [](Scene& s) { s.criteria.duration = 0.0; }},
      {"/criteria/window", [](Scene& s) { s.criteria.window = -1.0; }},
      {"/camera/width", [](Scene& s) { s.camera.width = 0.0; }},
      {"/effects", [](Scene& s) { s.effects.joints = false; }},
      {"/effects",
       [](Scene& s) {
         s.bodies[1].force = {1, 0, 0};
       }},
  };
}

TEST(Validate, AValidSceneHasNoProblems) {
  EXPECT_EQ(texts(validate(sound_scene())), "");
  Simulator simulator(std::make_shared<const Scene>(sound_scene()));
  EXPECT_TRUE(simulator.problems().empty());
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(Validate, ReportsTheProblemsOfTheReader) {
  for (const Break& broken : breaks_of_files()) {
    Scene scene = sound_scene();
    broken.apply(scene);
    const Problems in_code = validate(scene);
    ASSERT_FALSE(in_code.empty()) << broken.place;
    EXPECT_EQ(in_code.front().pointer, broken.place);
    const Problems in_file = read_scene(write_scene(scene)).problems;
    ASSERT_FALSE(in_file.empty()) << broken.place;
    EXPECT_EQ(to_string(in_code.front()), to_string(in_file.front()));
  }
}

/// One invalid value each, which only code can have.
std::vector<Break> breaks_of_code() {
  return {
      {"/joints/1/b", [](Scene& s) { link_of(s).b = -5; }},
      {"/joints/1/b", [](Scene& s) { link_of(s).b = 77; }},
      {"/joints/0/a", [](Scene& s) { base(s.joints[0]).a = 4; }},
      {"/joints/0/a", [](Scene& s) { base(s.joints[0]).a = kWorld; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = kNan; }},
      {"/bodies/1/inertia/0", [](Scene& s) { s.bodies[1].inertia.setZero(); }},
      {"/bodies/3/orientation",
       [](Scene& s) { s.bodies[3].orientation.coeffs().setConstant(kNan); }},
      {"/bodies/3/position/0", [](Scene& s) { s.bodies[3].position.setConstant(kNan); }},
      {"/bodies/1/collision_group", [](Scene& s) { s.bodies[1].collision_group = -7; }},
      {"/gravity/0", [](Scene& s) { s.gravity.x() = kNan; }},
      {"/settings/solver", [](Scene& s) { s.settings.solver = static_cast<SolverKind>(9); }},
      {"/settings/mode", [](Scene& s) { s.settings.mode = static_cast<Mode>(77); }},
      {"/start", [](Scene& s) { s.start = static_cast<StartPolicy>(3); }},
      {"/criteria/track", [](Scene& s) { s.criteria.track = 4; }},
      {"/criteria/displacement/body",
       [](Scene& s) {
         s.criteria.displacement = Criteria::Displacement{-2, 1.0};
       }},
      {"/carried/u", [](Scene& s) { s.carried = Carried{}; }},
  };
}

TEST(Validate, FindsProblemsThatOnlyCodeCanHave) {
  for (const Break& broken : breaks_of_code()) {
    Scene scene = sound_scene();
    broken.apply(scene);
    const Problems problems = validate(scene);
    ASSERT_FALSE(problems.empty()) << broken.place;
    EXPECT_EQ(problems.front().pointer, broken.place) << texts(problems);
    Simulator simulator(std::make_shared<const Scene>(scene));
    EXPECT_EQ(simulator.step().status, StepStatus::kInvalid) << broken.place;
    EXPECT_EQ(simulator.observe().status, StepStatus::kInvalid) << broken.place;
    ASSERT_FALSE(simulator.problems().empty());
    EXPECT_EQ(simulator.problems().front().pointer, broken.place);
  }
}

TEST(Validate, NamesThePlaceInCodeSyntax) {
  Scene scene = sound_scene();
  link_of(scene).b = 77;
  EXPECT_EQ(texts(validate(scene)),
            "joints[1].b: must be the index of a body, from 0 to 3, or -1 for the world, not 77\n");
  scene = sound_scene();
  scene.bodies[1].mass = 0.0;
  EXPECT_EQ(texts(validate(scene)), "bodies[1].mass: must be at least 1e-30 (kg), not 0\n");
}

TEST(Validate, ReportsAtMostAThousandProblems) {
  Scene scene = sound_scene();
  scene.bodies.resize(5000);
  for (Body& body : scene.bodies) body.mass = -1.0;
  EXPECT_EQ(validate(scene).size(), kMaxProblems);
}

TEST(Simulator, WithoutASceneRefusesEveryCall) {
  Simulator simulator(nullptr);
  EXPECT_EQ(simulator.step().status, StepStatus::kInvalid);
  EXPECT_EQ(simulator.substep().status, StepStatus::kInvalid);
  simulator.reset();
  simulator.set_state(State{});
  simulator.set_grab(Grab{});
  EXPECT_EQ(simulator.observe().status, StepStatus::kInvalid);
  EXPECT_TRUE(simulator.scene().bodies.empty());
  EXPECT_NE(texts(simulator.problems()).find("there is no scene"), std::string::npos);
}

TEST(Simulator, RefusesStatesOfOtherScenesAndKeepsItsOwn) {
  Simulator simulator(std::make_shared<const Scene>(sound_scene()));
  simulator.step();
  const State kept = simulator.state();
  using Spoil = std::function<void(State&)>;
  const std::vector<std::pair<const char*, Spoil>> spoils{
      {"/state/u", [](State& s) { s = State{}; }},
      {"/state/x", [](State& s) { s.x.pop_back(); }},
      {"/state/x/2", [](State& s) { s.x[2].y() = kNan; }},
      {"/state/q/1", [](State& s) { s.q[1].coeffs().setZero(); }},
      {"/state/u_synchronised", [](State& s) { s.u_synchronised.clear(); }},
      {"/state/k", [](State& s) { s.k.resize(3); }},
      {"/state/rotation", [](State& s) { s.rotation.resize(1); }},
      {"/state/own", [](State& s) { s.own.resize(1); }},
      {"/state/rest", [](State& s) { s.rest.resize(9); }},
      {"/state/rest/1",
       [](State& s) {
         s.rest = {0.0, -0.5, 0.0, 0.0};
       }},
      {"/state/forces/0",
       [](State& s) {
         s.forces.resize(1);
         s.forces[0].active_set[2] = 77;
       }},
      {"/state/dt_previous", [](State& s) { s.dt_previous = -1.0; }},
      {"/state/frame", [](State& s) { s.frame = -1; }},
  };
  for (const auto& [place, spoil] : spoils) {
    State state = kept;
    spoil(state);
    simulator.set_state(state);
    EXPECT_EQ(simulator.step().status, StepStatus::kInvalid) << place;
    ASSERT_FALSE(simulator.problems().empty()) << place;
    EXPECT_EQ(simulator.problems().front().pointer, place);
    EXPECT_EQ(state_hash(simulator.state()), state_hash(kept)) << place;
  }
  simulator.set_state(kept);
  EXPECT_TRUE(simulator.problems().empty());
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(Simulator, RefusesSettingsOutOfRangeUntilTheyAreReplaced) {
  Simulator simulator(std::make_shared<const Scene>(sound_scene()));
  PaperSettings settings;
  settings.alpha = 0.0;
  simulator.set_settings(settings);
  EXPECT_EQ(simulator.step().status, StepStatus::kInvalid);
  EXPECT_EQ(texts(simulator.problems()), "settings.alpha: must be above 0 and at most 1, not 0\n");
  EXPECT_EQ(simulator.settings().alpha, PaperSettings{}.alpha);
  EXPECT_EQ(simulator.state().frame, 0);
  settings.alpha = 0.2;
  simulator.set_settings(settings);
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(Simulator, RefusesAGrabOfAMissingOrStaticBody) {
  Simulator simulator(std::make_shared<const Scene>(sound_scene()));
  for (const int body : {99, -1, 4, 0}) {
    Grab grab;
    grab.body = body;
    simulator.set_grab(grab);
    EXPECT_EQ(simulator.step().status, StepStatus::kInvalid) << body;
    EXPECT_EQ(simulator.problems().front().pointer, "/grab/body");
    EXPECT_FALSE(simulator.grab().has_value());
  }
  Grab massless;
  massless.body = 1;
  massless.mass = 0.0;
  simulator.set_grab(massless);
  EXPECT_EQ(simulator.problems().front().pointer, "/grab/mass");
  simulator.set_grab(std::nullopt);
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

}  // namespace
}  // namespace substep
