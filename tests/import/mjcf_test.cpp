// MJCF: what becomes of joints, actuators, constraints and shapes. Masses, inertias, poses and
// motion are compared with MuJoCo by mujoco_test.mjs.

#include <gtest/gtest.h>

#include <numbers>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"
#include "tests/import/imported.hpp"

namespace substep {
namespace {

using test::body_called;
using test::error_of;
using test::imported;
using test::joint_called;
using test::lines;
using test::world;

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Mjcf, BecomesAValidSceneWithYUp) {
  const auto result = imported(world(
      "<body name='a' pos='1 2 3'><joint name='j' axis='1 0 0'/><geom size='0.5' pos='0 0 -1'/>"
      "</body>"));
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  const Scene& scene = *result.scene;
  EXPECT_TRUE(validate(scene).empty());
  EXPECT_EQ(scene.gravity, Vec3(0, -9.81, 0));
  EXPECT_LT((body_called(scene, "a").position - Vec3(1, 2, -2)).norm(), 1e-15);
  EXPECT_NEAR(body_called(scene, "a").mass, 1000.0 * 4.0 / 3.0 * std::numbers::pi / 8.0, 1e-12);
  EXPECT_LT((joint_called<HingeJoint>(scene, "j").anchor_b - Vec3(1, 3, -2)).norm(), 1e-15);
  const SceneResult again = read_scene(write_scene(scene));
  ASSERT_TRUE(again.problems.empty());
  EXPECT_EQ(write_scene(*again.scene), write_scene(scene));
}

TEST(Mjcf, ReportsTheStepAndTheIntegratorOfItsEngine) {
  const std::string body = "<body><joint/><geom size='0.1' pos='1 0 0'/></body>";
  const ImportReport silent = imported(world(body)).report;
  EXPECT_EQ(silent.timestep, 0.002) << "MuJoCo's default";
  EXPECT_EQ(silent.integrator, "Euler");
  const ImportReport own =
      imported(world(body, "<option timestep='5e-4'/><option integrator='RK4'/>")).report;
  EXPECT_EQ(own.timestep, 5e-4);
  EXPECT_EQ(own.integrator, "RK4");
  EXPECT_EQ(imported(world(body, "<option timestep='soon'/>")).report.timestep, 0.002);
}

TEST(Mjcf, MergesBodiesWithoutJointsIntoTheirParents) {
  const auto result = imported(world(
      "<body name='a'><freejoint/><geom type='box' size='0.1 0.1 0.1' mass='1'/>"
      "<body name='b' pos='1 0 0'><geom type='box' size='0.1 0.1 0.1' mass='3'/></body></body>"));
  ASSERT_NE(result.scene, nullptr);
  ASSERT_EQ(result.scene->bodies.size(), 1U);
  EXPECT_EQ(result.scene->bodies[0].mass, 4.0);
  EXPECT_LT((result.scene->bodies[0].position - Vec3(0.75, 0, 0)).norm(), 1e-15);
}

TEST(Mjcf, DefaultsAreInheritedFromClassesAndChildclasses) {
  const auto result = imported(
      world("<body childclass='inner'><joint name='inner'/><geom size='0.1'/></body>"
            "<body childclass='inner'><joint name='outer' class='outer'/><geom size='0.1'/></body>"
            "<body><joint name='main' damping='9'/><geom size='0.1'/></body>",
            "<default><joint damping='1' stiffness='4'/><default class='outer'><joint damping='2'/>"
            "<default class='inner'><joint stiffness='5'/></default></default></default>"));
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  const auto expect_spring = [&](const char* joint, double damping, double stiffness) {
    const auto& hinge = joint_called<HingeJoint>(*result.scene, joint);
    ASSERT_TRUE(hinge.spring) << joint;
    EXPECT_EQ(hinge.spring->damping, damping) << joint;
    EXPECT_EQ(hinge.spring->stiffness, stiffness) << joint;
    EXPECT_FALSE(hinge.drive) << joint;
  };
  expect_spring("inner", 2, 5);
  expect_spring("outer", 2, 4);
  expect_spring("main", 9, 4);
}

TEST(Mjcf, RangesAreRelativeToTheStart) {
  const auto result = imported(
      world("<body><joint name='j' ref='-45' range='-160 -40' springref='-50' stiffness='2'/>"
            "<geom size='0.1' pos='1 0 0'/></body>"));
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  const auto& hinge = joint_called<HingeJoint>(*result.scene, "j");
  ASSERT_TRUE(hinge.limit && hinge.spring);
  EXPECT_NEAR(hinge.limit->lower, -115 * kDegree, 1e-15);
  EXPECT_NEAR(hinge.limit->upper, 5 * kDegree, 1e-15);
  EXPECT_NEAR(hinge.spring->rest, -5 * kDegree, 1e-15);
}

TEST(Mjcf, AJointOutsideItsRangeStartsAtItsNearerEnd) {
  const auto result = imported(world(
      "<body name='a'><joint name='j' axis='0 1 0' range='30 90'/><geom size='0.1' pos='1 0 0'/>"
      "</body>"));
  ASSERT_NE(result.scene, nullptr);
  const double angle = 30 * kDegree;
  EXPECT_LT((body_called(*result.scene, "a").position - Vec3(std::cos(angle), -std::sin(angle), 0))
                .norm(),
            1e-15);
  EXPECT_NE(lines(result.report.approximated).find("joint 'j' starts at 0, outside its range"),
            std::string::npos);
}

// The bound of an actuator is not that of the spring and the damper of its joint.
TEST(Mjcf, ActuatorsAreDrivesBesideTheSpringOfTheirJoint) {
  const std::string body =
      "<body><joint name='j' stiffness='2' springref='0.1' damping='0.5' frictionloss='0.3'/>"
      "<geom size='0.1' pos='1 0 0'/></body>";
  const std::string radian = "<compiler angle='radian'/>";
  const auto drive_with = [&](const std::string& actuator) {
    const auto result = imported(world(body, radian, "<actuator>" + actuator + "</actuator>"));
    return joint_called<HingeJoint>(*result.scene, "j");
  };
  const auto passive = drive_with("<motor joint='j' gear='10'/>");
  EXPECT_FALSE(passive.drive);
  EXPECT_EQ(passive.spring->stiffness, 2.0);
  EXPECT_EQ(passive.spring->rest, 0.1);
  EXPECT_EQ(passive.spring->damping, 0.5);
  EXPECT_EQ(passive.friction, 0.3);
  const auto position =
      drive_with("<position joint='j' kp='3' kv='0.25' gear='2' forcerange='-7 7'/>");
  EXPECT_EQ(position.spring->stiffness, 2.0);
  EXPECT_EQ(position.drive->stiffness, 12.0);
  EXPECT_EQ(position.drive->damping, 1.0);
  EXPECT_EQ(position.drive->target, 0.0);
  EXPECT_EQ(position.drive->effort, 14.0);
  const auto general = drive_with(
      "<general joint='j' biastype='affine' gainprm='5' biasprm='1 -8 -1' ctrlrange='0.5 1'/>");
  EXPECT_EQ(general.drive->stiffness, 8.0);
  EXPECT_NEAR(general.drive->target, (5 * 0.5 + 1) / 8.0, 1e-15);
  const auto velocity = drive_with("<velocity joint='j' kv='0.5'/>");
  EXPECT_EQ(velocity.drive->damping, 0.5);
  EXPECT_EQ(velocity.drive->velocity, 0.0);
}

TEST(Mjcf, ADampingRatioCountsTheInertiaOfAllThatTheJointTurns) {
  const auto result = imported(world(
      "<body><joint name='j' axis='0 1 0' armature='0.5'/><geom size='0.1' mass='2' pos='1 0 0'/>"
      "<body pos='2 0 0'><joint axis='1 0 0'/><geom size='0.1' mass='3'/></body></body>",
      "", "<actuator><position joint='j' kp='100' dampratio='1'/></actuator>"));
  ASSERT_NE(result.scene, nullptr);
  const double of_balls = 0.4 * (2 + 3) * 0.01;
  EXPECT_NEAR(joint_called<HingeJoint>(*result.scene, "j").drive->damping,
              2 * std::sqrt(100 * (of_balls + 2 * 1 + 3 * 4 + 0.5)), 1e-12);
}

TEST(Mjcf, AKeyframeSetsPosesVelocitiesAndControls) {
  const std::string text = world(
      "<body name='a'><joint name='j' type='slide' axis='1 0 0'/><geom size='0.1'/></body>", "",
      "<actuator><position joint='j' kp='10'/></actuator>"
      "<keyframe><key qpos='0.1'/><key name='far' qpos='0.5' qvel='2' ctrl='0.7'/></keyframe>");
  const auto far = imported(text, {.key = "far"});
  ASSERT_NE(far.scene, nullptr) << lines(far.report.errors);
  EXPECT_EQ(body_called(*far.scene, "a").position, Vec3(0.5, 0, 0));
  EXPECT_EQ(body_called(*far.scene, "a").velocity, Vec3(2, 0, 0));
  EXPECT_NEAR(joint_called<PrismaticJoint>(*far.scene, "j").drive->target, 0.2, 1e-15);
  EXPECT_EQ(body_called(*imported(text, {.key = "1"}).scene, "a").position, Vec3(0.1, 0, 0));
  EXPECT_EQ(imported(text).report.starts, "1, far");
  EXPECT_EQ(error_of(text, {.key = "near"}),
            "model.xml: no keyframe is called 'near'; there are: 1, far");
}

// The range moves the joint, which opens the loop.
TEST(Mjcf, OtherStartsAreNamedIfTheFirstIsNotConsistent) {
  const auto result =
      imported(world("<body name='a'><joint name='j' axis='0 1 0' range='1 2'/>"
                     "<geom size='0.1' pos='1 0 0'/></body>",
                     "",
                     "<equality><connect body1='a' anchor='1 0 0'/></equality>"
                     "<keyframe><key name='home' qpos='1.5'/></keyframe>"));
  EXPECT_EQ(result.scene, nullptr);
  EXPECT_NE(lines(result.report.errors).find("other starts, for `substep import --key`: home"),
            std::string::npos)
      << lines(result.report.errors);
}

TEST(Mjcf, ConstraintsCloseLoopsWhereTheModelHasThem) {
  const std::string two =
      "<body name='a' pos='0 0 1'><joint axis='0 1 0'/><geom type='capsule' fromto='0 0 0 1 0 0' "
      "size='0.05'/><body name='b' pos='1 0 0'><joint axis='0 1 0'/><geom type='capsule' "
      "fromto='0 0 0 0 0 -1' size='0.05'/></body></body><site name='s' pos='1 0 0'/>";
  const auto connected = imported(
      world(two, "", "<equality><connect name='c' body1='b' anchor='0 0 -1'/></equality>"));
  ASSERT_NE(connected.scene, nullptr) << lines(connected.report.errors);
  EXPECT_LT((joint_called<BallJoint>(*connected.scene, "c").anchor_b - Vec3(1, 0, 0)).norm(),
            1e-15);
  const auto welded =
      imported(world(two, "", "<equality><weld name='w' body1='world' body2='b'/></equality>"));
  ASSERT_NE(welded.scene, nullptr) << lines(welded.report.errors);
  Simulator simulator(welded.scene);
  EXPECT_TRUE(simulator.start().found.consistent());
  EXPECT_NE(joint_called<WeldJoint>(*welded.scene, "w").name, "");
}

TEST(Mjcf, SeveralJointsInOnePlaceAreWhatTheyAreTogether) {
  const auto kind_of = [](const std::string& joints) {
    const auto result = imported(
        world("<body name='a'>" + joints + "<geom type='box' size='0.1 0.2 0.3'/></body>"));
    if (result.scene == nullptr) return lines(result.report.errors);
    std::string kinds;
    for (const Joint& joint : result.scene->joints) {
      kinds += std::string(std::visit([](const auto& j) { return j.kType; }, joint)) + " ";
    }
    return kinds;
  };
  const std::string x = "<joint axis='1 0 0'/>";
  const std::string y = "<joint axis='0 1 0'/>";
  const std::string z = "<joint axis='0 0 1'/>";
  EXPECT_EQ(kind_of(x + y), "ball distance ");
  EXPECT_EQ(kind_of(x + "<joint axis='0 1 0' pos='0 0 0.1'/>"),
            "distance distance distance distance ");
  EXPECT_EQ(kind_of(x + y + z), "ball ");
  const std::string slides =
      "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/>"
      "<joint type='slide' axis='0 0 1'/>";
  EXPECT_EQ(kind_of(slides + x + y + z), "");
  EXPECT_EQ(kind_of(slides + "<joint type='ball'/>"), "");
  const std::string refused =
      "model.xml:1: body 'a' has 2 joints (%s) that no joint of a scene expresses\n";
  const auto refusal = [&](const std::string& kinds) {
    std::string text = refused;
    return text.replace(text.find("%s"), 2, kinds);
  };
  EXPECT_EQ(kind_of(x + x), refusal("hinge, hinge"));
  EXPECT_EQ(kind_of(x + "<joint axis='1 0 0' pos='0 0 0.1'/>"), refusal("hinge, hinge"));
  EXPECT_EQ(kind_of(x + "<joint type='slide'/>"), refusal("hinge, slide"));
}

TEST(Mjcf, AUniversalJointTurnsAboutTwoAxesOnly) {
  const auto result =
      imported(world("<body name='a'><joint axis='1 0.2 0'/><joint axis='0.3 1 0.1'/>"
                     "<geom type='box' size='0.1 0.2 0.3' pos='0.4 0.1 -0.3'/></body>"));
  ASSERT_NE(result.scene, nullptr);
  Simulator simulator(result.scene);
  for (int i = 0; i < 120; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
  // The axis of the model that the body keeps stays at its angle to the one that the world keeps.
  const Quat start = result.scene->bodies[0].orientation;
  const Quat turn = simulator.state().q[0] * start.conjugate();
  const Vec3 first = Vec3(1, 0, -0.2).normalized();
  const Vec3 second = Vec3(0.3, 0.1, -1).normalized();
  EXPECT_NEAR((turn * second).dot(first), second.dot(first), 1e-9);
  EXPECT_GT(turn.angularDistance(Quat::Identity()), 0.1);
}

TEST(Mjcf, WhatIsNotReadIsListedWithItsLine) {
  const auto result = imported(
      "<mujoco>\n<worldbody>\n<body>\n<joint name='j' armature='1' solreflimit='1 1'/>\n"
      "<geom size='0.1'/>\n<composite/>\n</body>\n</worldbody>\n<tendon>\n<spatial/>\n</tendon>\n"
      "<deformable/>\n<actuator>\n<muscle joint='j'/>\n</actuator>\n"
      "<equality>\n<joint joint1='j'/>\n</equality>\n</mujoco>");
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  EXPECT_EQ(lines(result.report.left_out),
            "model.xml:4: <joint> 'solreflimit'\n"
            "model.xml:6: <composite> and all that is in it\n"
            "model.xml:17: <equality> of kind 'joint'\n"
            "model.xml:14: an actuator of kind 'muscle'\n"
            "model.xml:10: a tendon (spatial)\n"
            "model.xml:12: <deformable> and all that is in it\n"
            "model.xml:3: collisions of a sphere, box or plane (--collide)\n");
  EXPECT_EQ(armature_of(result.scene->joints[0]), 1.0);
}

TEST(Mjcf, ShapesCollideOnRequestIfTheSceneCanHoldThem) {
  const std::string text = world(
      "<geom type='plane' size='1 1 1' friction='0.5'/><geom name='wall' type='box' size='1 1 1' "
      "pos='5 0 0'/>"
      "<body name='ball' pos='0 0 1'><freejoint/><geom size='0.5'/></body>"
      "<body name='brick' pos='2 0 1' euler='10 20 30'><freejoint/>"
      "<geom type='box' size='0.1 0.2 0.3' euler='30 0 0'/></body>"
      "<body name='pill' pos='0 2 1'><freejoint/><geom type='capsule' size='0.1 0.2'/></body>");
  const auto plain = imported(text);
  ASSERT_NE(plain.scene, nullptr);
  for (const Body& body : plain.scene->bodies) EXPECT_FALSE(body.collides) << body.name;
  const auto collides = imported(text, {.key = "", .collide = true});
  ASSERT_NE(collides.scene, nullptr) << lines(collides.report.errors);
  const Scene& scene = *collides.scene;
  EXPECT_TRUE(body_called(scene, "ball").collides);
  EXPECT_EQ(std::get<Sphere>(body_called(scene, "ball").shape).radius, 0.5);
  EXPECT_TRUE(body_called(scene, "brick").collides);
  EXPECT_EQ(std::get<Box>(body_called(scene, "brick").shape).half_extents, Vec3(0.1, 0.2, 0.3));
  EXPECT_FALSE(body_called(scene, "pill").collides);
  EXPECT_TRUE(body_called(scene, "floor").collides);
  // A ball on the floor rests.
  Simulator simulator(collides.scene);
  for (int i = 0; i < 120; ++i) simulator.step();
  EXPECT_NEAR(simulator.state().x[2].y(), 0.5, 1e-3);
}

TEST(Mjcf, AShapeAwayFromTheCentreOfMassIsNotThatOfTheBody) {
  const auto result = imported(
      world("<body name='a'><freejoint/><inertial pos='0 0 0.1' mass='1' diaginertia='1 1 1'/>"
            "<geom size='0.5'/></body>"),
      {.key = "", .collide = true});
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  EXPECT_FALSE(result.scene->bodies[0].collides);
  EXPECT_EQ(lines(result.report.approximated),
            "model.xml:1: a body is drawn as the box of its inertia and does not collide\n");
}

TEST(Mjcf, ABodyIsDrawnAsTheBoxOfItsInertia) {
  const auto result = imported(
      world("<body><freejoint/><inertial pos='0 0 0' mass='3' diaginertia='1.25 1 0.75'/></body>"));
  ASSERT_NE(result.scene, nullptr);
  const Body& body = result.scene->bodies[0];
  EXPECT_LT((solid_inertia(body.shape, body.mass) - body.inertia).norm(), 1e-14);
}

TEST(Mjcf, AMeshHasTheMassOfItsConvexHull) {
  const std::string obj = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 1\nv 0.1 0.1 0.1\nf 1 2 3\n";
  const std::string text =
      world("<body name='a'><freejoint/><geom type='mesh' mesh='part' density='10'/></body>",
            "<compiler meshdir='parts'/><asset><mesh file='part.obj'/></asset>");
  const auto result = imported(text, {}, {{"parts/part.obj", obj}});
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  EXPECT_NEAR(result.scene->bodies[0].mass, 10.0, 1e-13);
  EXPECT_LT((result.scene->bodies[0].position - Vec3(0.5, 0.25, -0.75)).norm(), 1e-14);
  EXPECT_EQ(error_of(text),
            "model.xml:1: body 'a' moves but has no mass: there is no file 'part.obj'");
}

TEST(Mjcf, ABinaryStlIsReadToItsLastTriangle) {
  // A tetrahedron, as triangles of single precision with normals that do not count.
  const float corners[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}};
  const int triangles[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  std::string stl(80, ' ');
  stl += std::string("\4\0\0\0", 4);
  for (const auto& triangle : triangles) {
    stl += std::string(12, '\0');
    for (const int corner : triangle) {
      stl.append(reinterpret_cast<const char*>(corners[corner]), 12);
    }
    stl += std::string(2, '\0');
  }
  const std::string text =
      world("<body name='a'><freejoint/><geom type='mesh' mesh='part' density='10'/></body>",
            "<asset><mesh file='part.stl'/></asset>");
  const auto result = imported(text, {}, {{"part.stl", stl}});
  ASSERT_NE(result.scene, nullptr) << lines(result.report.errors);
  EXPECT_NEAR(result.scene->bodies[0].mass, 10.0, 1e-13);
  EXPECT_EQ(error_of(text, {}, {{"part.stl", stl.substr(0, stl.size() - 1)}}),
            "model.xml:1: body 'a' moves but has no mass: it is no binary STL");
}

}  // namespace
}  // namespace substep
