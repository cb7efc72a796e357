// What `substep export` writes: which joints carry bodies, names, and what it lists.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/import/export_mjcf.hpp"
#include "core/import/kinematic_tree.hpp"
#include "core/math/random.hpp"
#include "core/model/scene_builder.hpp"
#include "tests/import/imported.hpp"

namespace substep {
namespace {

using test::imported;
using test::lines;

int add_link(SceneBuilder& builder, const Vec3& at) {
  const int i = builder.add_body(Box{{0.1, 0.05, 0.05}}, 1.0, at);
  builder.body(i).collides = false;
  return i;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Of a loop of three links, the ball joint closes it, wherever it is in the list.
TEST(KinematicTree, KeepsTheJointsThatNothingReplaces) {
  SceneBuilder builder("loop");
  const int first = add_link(builder, {0.0, 0.0, 0.0});
  const int second = add_link(builder, {1.0, 0.0, 0.0});
  const int free = add_link(builder, {5.0, 0.0, 0.0});
  const int third = add_link(builder, {1.0, 1.0, 0.0});
  builder.add_ball_joint(second, first, {0.5, 0.0, 0.0});
  builder.add_hinge(first, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.add_hinge(second, third, {1.0, 0.5, 0.0}, Vec3::UnitZ());
  builder.add_prismatic(third, kWorld, {1.0, 1.0, 0.0}, Vec3::UnitX());
  const KinematicTree tree = KinematicTree::of(*builder.build());
  EXPECT_EQ(tree.closing, std::vector<int>{0});
  ASSERT_EQ(tree.nodes.size(), 4U);
  const auto node = [&](int body) {
    return *std::find_if(tree.nodes.begin(), tree.nodes.end(),
                         [&](const KinematicTree::Node& of) { return of.body == body; });
  };
  EXPECT_EQ(node(second).parent, third);
  EXPECT_EQ(node(second).joint, 2);
  EXPECT_EQ(node(second).depth, 2);
  EXPECT_EQ(node(third).joint, 3);
  EXPECT_EQ(node(free).joint, -1);
  EXPECT_EQ(node(free).parent, kWorld);
}

TEST(KinematicTree, TakesStaticBodiesForTheWorld) {
  SceneBuilder builder("hung");
  const int wall = builder.add_fixed(Box{}, {0.0, 2.0, 0.0});
  const int link = add_link(builder, Vec3::Zero());
  builder.add_ball_joint(link, wall, {0.0, 1.0, 0.0});
  builder.add_ball_joint(link, kWorld, {0.1, 1.0, 0.0});
  const KinematicTree tree = KinematicTree::of(*builder.build());
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].parent, kWorld);
  EXPECT_EQ(tree.nodes[0].joint, 0);
  EXPECT_EQ(tree.closing, std::vector<int>{1});
}

// Letters that XML, MuJoCo or a line of text could take amiss.
std::string hostile_name(Random& random) {
  static const std::vector<std::string> kParts{
      "<", ">", "&", "\"", "'", "]]>", "--", "<!--", "&amp;", "&#10;",   "/",  "\\",
      " ", "=", "a", "Z",  "0", "é",   "字", "😀",    "%s",    "<body/>", "?>", "<![CDATA["};
  std::string name = "n";
  const int count = 1 + static_cast<int>(6.0 * std::abs(random.next()));
  for (int i = 0; i < count; ++i) {
    const double at = 0.5 * (random.next() + 1.0) * static_cast<double>(kParts.size());
    name += kParts[std::min(static_cast<std::size_t>(at), kParts.size() - 1)];
  }
  return name + ".";
}

TEST(ExportMjcf, NamesComeBack) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    SceneBuilder builder("names");
    const int link = add_link(builder, Vec3::Zero());
    const int joint = builder.add_ball_joint(link, kWorld, Vec3::UnitX());
    builder.body(link).name = hostile_name(random);
    builder.joint(joint).name = hostile_name(random);
    const Scene scene = *builder.build();
    const ExportedModel model = export_mjcf(scene);
    const ImportResult again = imported(model.text);
    ASSERT_TRUE(again.scene) << model.text << lines(again.report.errors);
    EXPECT_EQ(again.scene->bodies.at(0).name, scene.bodies[0].name);
    EXPECT_EQ(base(again.scene->joints.at(0)).name, base(scene.joints[0]).name);
    EXPECT_TRUE(model.approximated.empty()) << lines(model.approximated);
  }
}

TEST(ExportMjcf, NamesDifferAndAreNotTheWorlds) {
  SceneBuilder builder("names");
  for (int i = 0; i < 3; ++i) {
    const int link = add_link(builder, {1.0 * i, 0.0, 0.0});
    builder.body(link).name = i == 0 ? "world" : "twin";
    builder.joint(builder.add_ball_joint(link, kWorld, {1.0 * i, 1.0, 0.0})).name = "pin";
  }
  const ExportedModel model = export_mjcf(*builder.build());
  const ImportResult again = imported(model.text);
  ASSERT_TRUE(again.scene) << model.text << lines(again.report.errors);
  EXPECT_EQ(again.scene->bodies.size(), 3U);
  EXPECT_TRUE(has(lines(model.approximated), "body world: is called '"));
  EXPECT_TRUE(has(lines(model.approximated), "body twin: is called '"));
  EXPECT_TRUE(has(lines(model.approximated), "joint pin: is called '"));
}

TEST(ExportMjcf, RodsAndRopesAreTendons) {
  SceneBuilder builder("rods");
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {0.0, -1.0, 0.0});
  const int other = builder.add_body(Sphere{0.1}, 1.0, {0.0, -2.0, 0.0});
  for (const int i : {ball, other}) builder.body(i).collides = false;
  builder.add_distance(ball, kWorld, {0.0, -1.0, 0.0}, Vec3::Zero());
  builder.add_rope(other, ball, {0.0, -2.0, 0.0}, {0.0, -1.0, 0.0}, 1.5);
  const std::string text = export_mjcf(*builder.build()).text;
  EXPECT_TRUE(has(text, "<tendon name=\"joint_0\" tendon1=\"joint_0\" polycoef=\"0 0 0 0 0\"/>"));
  EXPECT_TRUE(has(text, "range=\"0 1.5\"><site site=\"joint_1_a\"/><site site=\"joint_1_b\"/>"));
  EXPECT_TRUE(has(text, "<freejoint/>"));
}

TEST(ExportMjcf, VelocitiesAreThoseOfAKeyframe) {
  SceneBuilder builder("moving");
  const int free = builder.add_body(Box{{0.3, 0.1, 0.2}}, 2.0, {0.0, 3.0, 0.0});
  builder.body(free).collides = false;
  builder.body(free).orientation = Quat(0.5, 0.5, -0.5, 0.5);
  builder.body(free).velocity = {1.0, 2.0, 3.0};
  builder.body(free).angular_velocity = {-1.0, 0.5, 2.0};
  const Scene scene = *builder.build();
  const ExportedModel model = export_mjcf(scene);
  EXPECT_TRUE(model.has_velocities);
  ImportOptions options;
  options.key = "start";
  const ImportResult again = imported(model.text, options);
  ASSERT_TRUE(again.scene) << lines(again.report.errors);
  const Body& body = again.scene->bodies.at(0);
  EXPECT_LT((body.velocity - scene.bodies[0].velocity).norm(), 1e-15);
  EXPECT_LT((body.angular_velocity - scene.bodies[0].angular_velocity).norm(), 1e-14);
  EXPECT_LT((body.position - scene.bodies[0].position).norm(), 1e-15);
}

TEST(ExportMjcf, ListsWhatClosesALoopWithParts) {
  SceneBuilder builder("loop");
  const int link = add_link(builder, Vec3::Zero());
  builder.add_hinge(link, kWorld, Vec3::Zero(), Vec3::UnitZ());
  const int second = builder.add_hinge(link, kWorld, {0.0, 0.0, 1.0}, Vec3::UnitZ());
  const int slide = builder.add_prismatic(link, kWorld, Vec3::Zero(), Vec3::UnitX());
  builder.rub(0, 0.1);
  builder.rub(second, 0.2);
  const ExportedModel model = export_mjcf(*builder.build());
  EXPECT_TRUE(has(model.text, "type=\"slide\"")) << "it has no equality";
  EXPECT_EQ(slide, 2);
  EXPECT_EQ(lines(model.left_out),
            "joint joint_0: dry friction of a hinge that closes a loop (and 1 more)\n");
}

// Deeper than any stack of calls.
TEST(ExportMjcf, LongChainsNestDeeply) {
  SceneBuilder builder("rope");
  int above = kWorld;
  for (int i = 0; i < 3000; ++i) {
    const int link = add_link(builder, {0.0, -1.0 * i, 0.0});
    builder.add_ball_joint(link, above, {0.0, 0.5 - 1.0 * i, 0.0});
    above = link;
  }
  const ExportedModel model = export_mjcf(*builder.build());
  std::size_t closed = 0;
  for (std::size_t at = model.text.find("</body>"); at != std::string::npos;
       at = model.text.find("</body>", at + 1)) {
    ++closed;
  }
  EXPECT_EQ(closed, 3000U);
  EXPECT_TRUE(has(lines(model.approximated), "bodies nest deeper than MuJoCo reads"));
}

}  // namespace
}  // namespace substep
