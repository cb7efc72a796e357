// The shipped scene files, their generator and the writer.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <string>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/number_text.hpp"
#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/reference/golden_cases.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/unit/scene_bits.hpp"

namespace substep {
namespace {

std::string file_text(const std::string& name) {
  std::ifstream file(SUBSTEP_SOURCE_DIR "/scenes/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Reads a valid scene.
Scene read_back(const std::string& text) {
  const SceneResult result = read_scene(text);
  for (const Problem& problem : result.problems) ADD_FAILURE() << to_string(problem);
  return result.scene ? *result.scene : Scene{};
}

/// The shipped scenes and variants of them.
std::vector<Scene> many_scenes() {
  std::vector<Scene> all = scenes::shipped();
  for (const auto& start : scenes::bridge_starts()) all.push_back(scenes::bridge(start));
  for (const int n : {1, 10, 2000}) all.push_back(scenes::rope_of_n({.n = n}));
  all.push_back(scenes::swinging_box({.angle = {0.6, 0.8}, .compliance = 0.0}));
  return all;
}

TEST(SceneFiles, RegenerateByteForByte) {
  for (const Scene& scene : scenes::shipped()) {
    EXPECT_TRUE(write_scene(scene) == file_text(scene.name + ".json"))
        << scene.name << ".json is not what generate_scenes writes";
  }
}

TEST(SceneFiles, ReadBackBitForBit) {
  for (const Scene& scene : many_scenes()) {
    const Scene read = read_back(write_scene(scene));
    EXPECT_TRUE(test::bits_of(read) == test::bits_of(scene)) << scene.name;
    EXPECT_TRUE(read.settings == scene.settings) << scene.name;
    EXPECT_TRUE(read.recommended == scene.recommended) << scene.name;
    EXPECT_TRUE(read.verdicts == scene.verdicts) << scene.name;
  }
}

TEST(SceneWriter, KeepsEveryFieldThatDiffersFromItsDefault) {
  Scene scene = scenes::bridge();
  scene.frame = 0.01;
  scene.gravity = {1.0, -0.0, 2.0};
  scene.contact = {2e-9, 3e-9, 0.5};
  scene.regularisation = 1e-6;
  scene.start = StartPolicy::kKeep;
  scene.settings = {.solver = SolverKind::kPgs,
                    .iterations = 7,
                    .share_iterations = true,
                    .warm_start = true,
                    .forces = Forces::kNumerov,
                    .refinements = 2,
                    .pivots = 3,
                    .mode = Mode::kCapped,
                    .alpha = 0.3,
                    .n = 5,
                    .n_max = 6,
                    .n_cap = 8,
                    .policy = Policy::kSubstep,
                    .memory = 0.5,
                    .islands = true,
                    .sleep = true,
                    .probe = false,
                    .integrator = Integrator::kLeapfrog,
                    .gyroscopic = Gyroscopic::kExplicit,
                    .drift = Drift::kSoft,
                    .drift_tau = 0.01,
                    .detection = Detection::kFrame,
                    .contact_stiffness = ContactStiffness::kExact,
                    .rotation_criterion = false,
                    .friction_cone = FrictionCone::kCone,
                    .watch_stiffness = true};
  scene.criteria = {.duration = 3.0,
                    .joint_gap = 0.3,
                    .energy_gain = 4.0,
                    .energy_scale = 5.0,
                    .displacement = Criteria::Displacement{2, 0.25},
                    .track = 3,
                    .window = 1.5,
                    .holds = false};
  scene.verdicts = {{.solver = SolverKind::kPgs,
                     .mode = Mode::kConst,
                     .n = 3,
                     .integrator = Integrator::kLeapfrog,
                     .verdict = Expected::kFails,
                     .before = 0.25,
                     .why = "It is three."},
                    {.verdict = Expected::kDepends, .why = "Chance."}};
  Body& body = scene.bodies[4];
  body.inertia *= 1.1;
  body.velocity = {1.0, 2.0, 3.0};
  body.angular_velocity = {0.1, 0.2, 0.3};
  body.force = {-7.0, 0.5, 1e-3};
  body.torque = {0.0, 1.0 / 3.0, -2e5};
  scene.effects.external = true;
  body.collides = false;
  body.collision_group = 9;
  scene.title = "Quotes \" and \\ and \xc3\xa9";
  scene.camera.width = 12.5;
  const Scene read = read_back(write_scene(scene));
  EXPECT_TRUE(test::bits_of(read) == test::bits_of(scene));
  EXPECT_EQ(read.criteria.window, 1.5);
  EXPECT_EQ(read.camera.width, 12.5);
  EXPECT_TRUE(read.settings == scene.settings);
  EXPECT_TRUE(read.verdicts == scene.verdicts);
}

TEST(NumberText, ReadsBackToTheSameBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    const auto read = parse_number(number_text(x));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*read), std::bit_cast<std::uint64_t>(x));
  }
}

TEST(NumberText, IsShort) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(1e-8), "1e-8");
  EXPECT_EQ(number_text(1e20), "1e20");
  EXPECT_EQ(number_text(1e100), "1e100");
  EXPECT_EQ(number_text(1000.0), "1000");
  EXPECT_EQ(number_text(-25e7), "-25e7");
  EXPECT_EQ(number_text(1.0 / 3.0), "0.3333333333333333");
}

TEST(NumberText, AcceptsOnlyFiniteDecimals) {
  for (const char* text : {"", " 1", "1 ", "0x10", "inf", "nan", "1e999", "1,5", "one", "1e"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
}

/// The sum of the moments about each plank's centre vanishes: the equation of the chain.
TEST(Bridge, HangsInEquilibrium) {
  for (const auto& start : scenes::bridge_starts()) {
    const Scene scene = scenes::bridge(start);
    // Slopes are linear in the index, so second differences vanish.
    std::vector<double> slopes;
    for (const Body& body : scene.bodies) {
      if (!body.name.starts_with("plank")) continue;
      const Vec3 along = body.orientation * Vec3::UnitX();
      slopes.push_back(along.y() / along.x());
    }
    ASSERT_EQ(slopes.size(), 20U);
    for (std::size_t i = 2; i < slopes.size(); ++i) {
      EXPECT_NEAR(slopes[i] - 2.0 * slopes[i - 1] + slopes[i - 2], 0.0, 1e-13);
    }
    EXPECT_GT(slopes[1], slopes[0]);  // it sags
  }
}

TEST(Bridge, JointsAreClosed) {
  for (const auto& start : scenes::bridge_starts()) {
    const Scene scene = scenes::bridge(start);
    EXPECT_EQ(scene.joints.size(), 42U);
    for (const Joint& joint : scene.joints) {
      const JointBase& j = base(joint);
      const Vec3 a = scenes::world_point(scene.bodies[static_cast<std::size_t>(j.a)], j.anchor_a);
      const Vec3 b = j.b == kWorld ? j.anchor_b
                                   : scenes::world_point(
                                         scene.bodies[static_cast<std::size_t>(j.b)], j.anchor_b);
      EXPECT_NEAR((a - b).norm(), 0.0, 1e-13) << j.name;
    }
  }
}

/// Distance of a point to a box, from outside [m].
double distance_to(const Body& body, const Vec3& point) {
  const Vec3 local = body.orientation.conjugate() * (point - body.position);
  const Vec3 out =
      (local.cwiseAbs() - std::get<Box>(body.shape).half_extents).cwiseMax(Vec3::Zero());
  return out.norm();
}

TEST(Bridge, BallTouchesAndRolls) {
  for (const auto& start : scenes::bridge_starts()) {
    const Scene scene = scenes::bridge(start);
    const Body& ball = scene.bodies.back();
    EXPECT_EQ(ball.position.x(), start.ball_x);
    double least = 1.0;
    for (const Body& body : scene.bodies) {
      if (body.name.starts_with("plank")) least = std::min(least, distance_to(body, ball.position));
    }
    EXPECT_NEAR(least, 0.5, 1e-14);
    // The lowest point along the normal is at rest.
    const Vec3 normal{-ball.velocity.y(), ball.velocity.x(), 0.0};
    const Vec3 arm = -0.5 / start.ball_speed * normal;
    EXPECT_NEAR(ball.velocity.norm(), start.ball_speed, 1e-14);
    EXPECT_NEAR((ball.velocity + ball.angular_velocity.cross(arm)).norm(), 0.0, 1e-13);
  }
}

TEST(HeavyStack, JitterStaysWithinTwoMillimetres) {
  const Scene plain = scenes::heavy_stack();
  const Scene stress = scenes::heavy_stack_stress();
  ASSERT_EQ(plain.bodies.size(), stress.bodies.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < plain.bodies.size(); ++i) {
    const Vec3 moved = stress.bodies[i].position - plain.bodies[i].position;
    EXPECT_EQ(moved.y(), 0.0);
    if (!plain.bodies[i].name.starts_with("ball")) {
      EXPECT_EQ(moved, Vec3::Zero());
    }
    keep_largest(largest, moved.cwiseAbs().maxCoeff());
  }
  EXPECT_LE(largest, 0.002);
  EXPECT_GT(largest, 0.001);
}

TEST(SwingingBox, HasTheDesignedChain) {
  const Scene scene = scenes::swinging_box();
  EXPECT_EQ(scene.bodies.size(), 27U);
  EXPECT_EQ(scene.joints.size(), 26U);
  const Body& box = scene.bodies.back();
  const Vec3 direction{std::sqrt(3.0) / 2.0, -0.5, 0.0};
  EXPECT_NEAR((box.position - (Vec3{0.0, 12.0, 0.0} + 10.5 * direction)).norm(), 0.0, 1e-14);
  EXPECT_EQ(box.mass, 1000.0);
  EXPECT_FALSE(scene.effects.gyroscopic);
}

TEST(SceneFiles, EveryOneHasGoldenLines) {
  std::set<std::string> shipped;
  for (const Scene& scene : scenes::shipped()) shipped.insert(scene.name);
  EXPECT_EQ(std::set<std::string>(std::begin(golden::kScenes), std::end(golden::kScenes)), shipped);
}

}  // namespace
}  // namespace substep
