// URDF, and the JSON of SLRBS.

#include <gtest/gtest.h>

#include "core/sim/simulator.hpp"
#include "tests/import/imported.hpp"

namespace substep {
namespace {

using test::body_called;
using test::error_of;
using test::imported;
using test::joint_called;
using test::lines;

std::string link(const std::string& name, double mass = 1.0) {
  const std::string value = std::to_string(mass);
  return "<link name='" + name + "'><inertial><mass value='" + value +
         "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
}
std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name='to_" + child + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + more + "</joint>";
}
std::string robot(const std::string& content) { return "<robot name='r'>" + content + "</robot>"; }

TEST(Urdf, TheRootIsFixedUnlessItIsFreed) {
  const std::string text = robot(link("base") + link("arm") + joint("continuous", "base", "arm"));
  const auto fixed = imported(text);
  ASSERT_NE(fixed.scene, nullptr) << lines(fixed.report.errors);
  EXPECT_TRUE(body_called(*fixed.scene, "base").is_static);
  EXPECT_NE(lines(fixed.report.approximated).find("link 'base' is fixed"), std::string::npos);
  const auto free = imported(text, {.key = "", .free_root = true});
  ASSERT_NE(free.scene, nullptr);
  EXPECT_FALSE(body_called(*free.scene, "base").is_static);
  EXPECT_EQ(joint_called<HingeJoint>(*free.scene, "to_arm").name, "to_arm");
}

TEST(Urdf, JointsHaveTheirLimitsAndDynamics) {
  const auto result = imported(
      robot(link("base") + link("arm") + link("slide") +
            joint("revolute", "base", "arm",
                  "<axis xyz='0 0 2'/><limit lower='-1' upper='0.5' effort='1' velocity='1'/>"
                  "<dynamics damping='0.2' friction='0.3'/>") +
            joint("prismatic", "arm", "slide",
                  "<limit lower='0' upper='0.1' effort='1' velocity='1'/>")));
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  const auto& hinge = joint_called<HingeJoint>(*result.scene, "to_arm");
  EXPECT_EQ(hinge.limit->lower, -1.0);
  EXPECT_EQ(hinge.spring->damping, 0.2);
  EXPECT_EQ(hinge.friction, 0.3);
  EXPECT_EQ(joint_called<PrismaticJoint>(*result.scene, "to_slide").limit->upper, 0.1);
}

TEST(Urdf, LinksWithoutMassJoinTheNextOne) {
  const auto result = imported(
      robot(link("base") + "<link name='dummy'/>" + link("arm") +
            joint("continuous", "base", "dummy", "<axis xyz='1 0 0'/><origin xyz='0 0 1'/>") +
            joint("continuous", "dummy", "arm", "<axis xyz='0 1 0'/>")));
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  EXPECT_EQ(result.scene->bodies.size(), 2U);
  EXPECT_EQ(result.scene->joints.size(), 2U);  // a universal joint
  EXPECT_EQ(
      error_of(robot(link("base") + "<link name='end'/>" + joint("continuous", "base", "end"))),
      "model.xml:1: body 'end' moves but has no mass");
}

TEST(Urdf, RefusesTreesThatAreNone) {
  EXPECT_EQ(error_of(robot("")), "model.xml:1: the robot has no links");
  EXPECT_EQ(error_of(robot(link("a") + joint("fixed", "a", "b"))),
            "model.xml:1: no link is called 'b'");
  EXPECT_EQ(error_of(robot(link("a") + link("a"))), "model.xml:1: another link is called 'a'");
  EXPECT_EQ(
      error_of(robot(link("a") + link("b") + joint("fixed", "a", "b") + joint("fixed", "a", "b"))),
      "model.xml:1: link 'b' is the child of two joints");
  EXPECT_EQ(
      error_of(robot(link("a") + link("b") + joint("fixed", "a", "b") + joint("fixed", "b", "a"))),
      "model.xml:1: the joints of some links form a circle");
  EXPECT_EQ(error_of(robot(link("a") + link("b") + joint("planar", "a", "b"))),
            "model.xml:1: joint 'to_b': type must be fixed, revolute, continuous, prismatic or "
            "floating, not 'planar'");
}

std::string slrbs(const std::string& bodies, const std::string& joints = "") {
  return R"({"name": "Two Boxes", "bodies": [)" + bodies + R"(], "joints": [)" + joints + "]}";
}
std::string box(int id, const std::string& more, double y = 0.0) {
  return R"({"id": )" + std::to_string(id) + R"(, "position": {"x": 0, "y": )" + std::to_string(y) +
         R"(, "z": 0}, "geometry": {"type": "box", "dimensions": )" +
         R"({"x": 1, "y": 2, "z": 3}}, )" + more + "}";
}
constexpr const char* kHinge =
    R"({"type": "hinge", "body0_id": 0, "body1_id": 1, "body0_offset": {"x": 0, "y": -1, "z": 0},
        "body1_offset": {"x": 0, "y": 1, "z": 0},
        "body1_orientation": {"w": 0, "x": 0, "y": 0, "z": 1}})";

TEST(Slrbs, BecomesAScene) {
  const auto two =
      imported(slrbs(box(0, R"("fixed": true)", 2.0) + "," +
                         box(1, R"("mass": 3, "linear_velocity": {"x": 0, "y": 0, "z": 1})"),
                     kHinge));
  ASSERT_NE(two.scene, nullptr) << lines(two.report.errors);
  EXPECT_EQ(two.scene->name, "two_boxes");
  const Body& body = body_called(*two.scene, "body_1");
  EXPECT_EQ(std::get<Box>(body.shape).half_extents, Vec3(0.5, 1, 1.5));
  EXPECT_EQ(body.velocity, Vec3(0, 0, 1));
  EXPECT_EQ(body.inertia, solid_inertia(body.shape, 3.0));
  // The frames of its hinge point against each other.
  ASSERT_EQ(two.scene->joints.size(), 1U);
  Simulator simulator(two.scene);
  EXPECT_EQ(simulator.step().status, StepStatus::kOk);
}

TEST(Slrbs, SaysWhatIsWrongAndWhere) {
  const std::string bodies = box(0, R"("fixed": true)", 9.0) + "," + box(1, R"("mass": 3)");
  EXPECT_EQ(
      error_of(slrbs(bodies, kHinge)).find("/joints/0: joint 'joint_0': the anchors start 7 apart"),
      0U);
  EXPECT_EQ(error_of(slrbs(box(0, R"("mass": 0)"))),
            "/bodies/0/mass: must be at least 1e-30 (kg), not 0");
  EXPECT_EQ(error_of(slrbs(box(0, R"("mass": 1)"), R"({"type": "hinge", "body0_id": 0,
                           "body1_id": 5})")),
            "/joints/0/body1_id: no body has this id");
  EXPECT_EQ(error_of("{}"), "model.xml: is not a model in MJCF, URDF or the JSON of SLRBS");
}

TEST(ImportModel, KnowsAModelByItsContent) {
  EXPECT_TRUE(is_model("  <mujoco/>"));
  EXPECT_TRUE(is_model(slrbs(box(0, R"("mass": 1)"))));
  EXPECT_FALSE(is_model(R"({"format": "substep-scene", "bodies": []})"));
  EXPECT_FALSE(is_model("{"));
  EXPECT_FALSE(is_model(""));
}

}  // namespace
}  // namespace substep
