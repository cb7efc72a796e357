// Broken and hostile models: each is refused, with its place and what is allowed there.

#include <gtest/gtest.h>

#include "tests/import/imported.hpp"

namespace substep {
namespace {

using test::error_of;
using test::Files;
using test::imported;
using test::world;

TEST(HostileModels, NumbersOutOfRangeAreRefusedWithTheirLine) {
  const auto body = [](const std::string& attributes) {
    return "<mujoco><worldbody>\n<body name='a'>\n<joint name='j' " + attributes +
           "/>\n<geom size='1'/></body></worldbody></mujoco>";
  };
  EXPECT_EQ(error_of(body("pos='0 0'")),
            "model.xml:3: joint 'j': pos must be 3 numbers, not '0 0'");
  EXPECT_EQ(error_of(body("pos='0 0 nan'")),
            "model.xml:3: joint 'j': pos must be 3 numbers, not '0 0 nan'");
  EXPECT_EQ(error_of(body("pos='0 0 inf'")),
            "model.xml:3: joint 'j': pos must be 3 numbers, not '0 0 inf'");
  EXPECT_EQ(error_of(body("pos='0 0 1e999'")),
            "model.xml:3: joint 'j': pos must be 3 numbers, not '0 0 1e999'");
  EXPECT_EQ(error_of(body("pos='0 0 1e300'")),
            "model.xml:3: joint 'j': pos must be at most 1e6 (m), not 1e300");
  EXPECT_EQ(error_of(body("axis='0 0 0'")), "model.xml:3: joint 'j': axis has length 0");
  EXPECT_EQ(error_of(body("damping='-1'")),
            "model.xml:3: joint 'j': damping must be at least 0 (N m s/rad or N s/m), not -1");
  EXPECT_EQ(error_of(body("range='2 1'")),
            "model.xml:3: joint 'j': a limited joint needs a range, from lower to upper");
  EXPECT_EQ(error_of(body("type='cardan'")),
            "model.xml:3: joint 'j': type must be free, ball, slide or hinge, not 'cardan'");
  EXPECT_EQ(error_of(body("limited='maybe'")),
            "model.xml:3: joint 'j': limited must be true, false or auto, not 'maybe'");
}

TEST(HostileModels, NamesThatNobodyHasAreRefused) {
  const std::string body = "<body name='a'><joint name='j'/><geom size='1'/></body>";
  EXPECT_EQ(error_of(world(body, "", "<actuator><motor joint='k'/></actuator>")),
            "model.xml:1: <motor>: no joint is called 'k'");
  EXPECT_EQ(error_of(world(body, "", "<equality><connect body1='a' body2='b'/></equality>")),
            "model.xml:1: <connect>: no body is called 'b'");
  EXPECT_EQ(error_of(world(body, "", "<equality><weld site1='s' site2='s'/></equality>")),
            "model.xml:1: <weld>: no site is called 's'");
  EXPECT_EQ(error_of(world("<body childclass='c'><joint/><geom size='1'/></body>")),
            "model.xml:1: no default class is called 'c'");
  EXPECT_EQ(error_of(world("<body><joint/><geom type='mesh' mesh='m'/></body>")),
            "model.xml:1: <geom>: no mesh is called 'm'");
  EXPECT_EQ(error_of(world(body + body)),
            "model.xml:1: body 'a': another body has this name\n"
            "model.xml:1: joint 'j': another joint has this name");
}

TEST(HostileModels, ImpossibleBodiesAreRefused) {
  EXPECT_EQ(error_of(world("<body name='a'><joint/></body>")),
            "model.xml:1: body 'a' moves but has no mass");
  EXPECT_EQ(
      error_of(world("<body name='a'><joint/><inertial mass='1' diaginertia='1 1 3'/></body>")),
      "model.xml:1: body 'a': no body has these moments: 3 is more than the sum of the other "
      "two, 2 (kg m^2)");
  EXPECT_EQ(
      error_of(world("<body name='a'><joint/><inertial mass='1' diaginertia='1 1 0'/></body>")),
      "model.xml:1: body 'a': its moments of inertia are not positive");
  EXPECT_EQ(error_of(world("")), "/bodies: no body moves");
  EXPECT_EQ(error_of(world("<joint/>")), "model.xml:1: <joint>: the world has no joints");
  EXPECT_EQ(error_of(world("<body><joint/><geom type='box' size='1 1'/></body>")),
            "model.xml:1: <geom>: a box needs 3 sizes above 0 (m)");
}

TEST(HostileModels, IncludesAreReadOnceAndInPlace) {
  const std::string text = "<mujoco><include file='part.xml'/></mujoco>";
  const std::string part =
      "<mujoco><worldbody><body><joint/><geom size='1'/></body></worldbody></mujoco>";
  EXPECT_NE(imported(text, {}, {{"part.xml", part}}).scene, nullptr);
  EXPECT_EQ(error_of(text), "model.xml:1: there is no file 'part.xml'");
  EXPECT_EQ(error_of(text, {}, {{"part.xml", text}}),
            "part.xml:1: 'part.xml' is included twice, or includes itself");
  EXPECT_EQ(error_of("<mujoco><include file='model.xml'/></mujoco>", {}, {{"model.xml", text}}),
            "model.xml:1: 'model.xml' is included twice, or includes itself");
  EXPECT_EQ(error_of(text, {}, {{"part.xml", "<mujoco>\n<a>"}}),
            "part.xml:2: the file ends inside <a> of line 2");
  EXPECT_EQ(error_of("<mujoco><include/></mujoco>"), "model.xml:1: <include> has no file");
}

TEST(HostileModels, IncludesCannotNestDeeperThanOneFile) {
  Files files;
  std::string deep = "<include file='1'/>";
  for (int i = 0; i < 200; ++i) deep = "<frame>" + deep + "</frame>";
  for (int i = 1; i < 50; ++i) {
    std::string text = "<include file='" + std::to_string(i + 1) + "'/>";
    for (int level = 0; level < 200; ++level) text = "<frame>" + text + "</frame>";
    files[std::to_string(i)] = "<mujoco>" + text + "</mujoco>";
  }
  EXPECT_EQ(error_of(world(deep), {}, files), "1:1: nested deeper than 256 elements");
}

TEST(HostileModels, CopiesAreBounded) {
  std::string copies = "<body><joint/><geom size='1'/></body>";
  for (int i = 0; i < 20; ++i) copies = "<replicate count='100'>" + copies + "</replicate>";
  EXPECT_NE(error_of(world(copies)).find("<replicate>: more than 10000 copies"), std::string::npos);
}

TEST(HostileModels, OtherFormatsAreNamed) {
  EXPECT_EQ(error_of("<sdf/>"), "model.xml:1: <sdf> is neither <mujoco> (MJCF) nor <robot> (URDF)");
  EXPECT_EQ(error_of(""), "model.xml: the file is empty");
  EXPECT_EQ(error_of("<mujoco>"), "model.xml:1: the file ends inside <mujoco> of line 1");
}

TEST(HostileModels, ABodyDeepInAChainIsRead) {
  std::string chain;
  std::string ends;
  for (int i = 0; i < 250; ++i) {
    chain += "<body pos='0 0 -0.1'><joint axis='1 0 0'/><geom size='0.01'/>";
    ends += "</body>";
  }
  const auto result = imported(world(chain + ends));
  ASSERT_NE(result.scene, nullptr) << test::lines(result.report.errors);
  EXPECT_EQ(result.scene->joints.size(), 250U);
}

}  // namespace
}  // namespace substep
