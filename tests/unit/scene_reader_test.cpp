// Values that the reader of scene files accepts, rejects and derives, beyond single faults.

#include <gtest/gtest.h>

#include <string>

#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_limits.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

using test::kGood;
using test::List;
using test::problems_of;
using test::with;

TEST(SceneReader, AcceptsAValidScene) { EXPECT_EQ(problems_of(kGood), List{}); }

TEST(SceneReader, ReportsAllProblemsAtOnce) {
  std::string text = with(R"("mass": 2)", R"("mass": -2)");
  text = with(R"("radius": 0.5)", R"("radius": 1e999)", text);
  text = with(R"("alpha": 0.1)", R"("alpha": 7, "alpha": 8)", text);
  text = with(R"("type": "plane")", R"("type": "disc")", text);
  text = with(R"("a": "ball")", R"("a": "bal")", text);
  text = with(R"("track": "arm")", R"("trakc": "arm")", text);
  EXPECT_EQ(problems_of(text),
            (List{"/bodies/2/shape/radius: 1e999 is beyond the range of numbers (1.8e308)",
                  "/settings/alpha: the key occurs twice in this object",
                  "/bodies/0/shape/type: must be sphere, box or plane, not \"disc\"",
                  "/bodies/1/mass: must be at least 1e-30 (kg), not -2",
                  "/criteria/trakc: unknown key (did you mean \"track\"?)",
                  "/joints/1/a: no body is called \"bal\" (did you mean \"ball\"?)"}));
}

TEST(SceneReader, NamesLineAndColumnOfASyntaxError) {
  const List problems = problems_of("{\n  \"format\": \"substep-scene\",\n  \"version\" 1\n}");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].find("line 3, column 13: syntax error"), 0U) << problems[0];
}

TEST(SceneReader, NamesLineAndColumnOfNaN) {
  const List problems = problems_of(with("\"mass\": 2", "\"mass\": NaN"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].find("line 14, column "), 0U) << problems[0];
  EXPECT_NE(problems[0].find("invalid literal"), std::string::npos) << problems[0];
}

TEST(SceneReader, RefusesTextsThatAreNoScenes) {
  const auto only = [](const std::string& text) {
    const List problems = problems_of(text);
    return problems.size() == 1 ? problems[0] : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(only(""), "the file is empty");
  EXPECT_EQ(only(" \n\t"), "the file is empty");
  for (const char* xml : {"<mujoco/>", "\n <?xml version=\"1.0\"?><robot name=\"a\"></robot>"}) {
    EXPECT_EQ(only(xml),
              "is XML: scenes are JSON; `substep import` makes one of a model in MJCF or URDF");
  }
  EXPECT_EQ(only("[1, 2]"), "must be an object, not [1,2]");
  EXPECT_EQ(only("3"), "must be an object, not 3");
  EXPECT_EQ(only(std::string("\x7f"
                             "ELF\0\0",
                             6)),
            "line 1, column 5: a zero byte: this is not a text file");
  EXPECT_EQ(only(kGood + "}").find("line 25, column 2: syntax error"), 0U) << only(kGood + "}");
  EXPECT_EQ(only(kGood.substr(0, 300)).find("line 10, column "), 0U) << only(kGood.substr(0, 300));
  const std::string bad_utf8 = only(with("Good",
                                         "Go\xff"
                                         "d"));
  EXPECT_NE(bad_utf8.find("ill-formed UTF-8"), std::string::npos) << bad_utf8;
  EXPECT_EQ(only(std::string(100, '[')),
            "/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0: nested deeper than 16 levels");
  EXPECT_EQ(only(std::string(kMaxTextSize + 1, ' ')),
            "must have at most 33554432 bytes (32 MiB), not 33554433");
}

TEST(SceneReader, RefusesMoreBodiesThanAllowed) {
  std::string bodies;
  for (std::size_t i = 0; i <= kMaxBodies; ++i) bodies += i == 0 ? "0" : ",0";
  const List problems = problems_of(
      R"({"format": "substep-scene", "version": 1, "name": "a", "title": "A", "bodies": [)" +
      bodies + "]}");
  EXPECT_EQ(problems, List{"/bodies: must have at most 20000 items, not 20001"});
}

TEST(SceneReader, TruncatesALongListOfProblems) {
  std::string bodies;
  for (std::size_t i = 0; i < kMaxBodies; ++i) bodies += i == 0 ? "0" : ",0";
  const List problems = problems_of(
      R"({"format": "substep-scene", "version": 1, "name": "a", "title": "A", "bodies": [)" +
      bodies + "]}");
  ASSERT_EQ(problems.size(), kMaxProblems + 1);
  EXPECT_EQ(problems.back(), "and more: the rest of the file was not checked");
}

TEST(SceneReader, TruncatesTheProblemsOfOneObject) {
  std::string keys;
  for (int i = 0; i < 5000; ++i) keys += "\"key_" + std::to_string(i) + "\": 0, \"twice\": 1, ";
  const List problems = problems_of(with(R"("mass": 2)", keys + R"("mass": 2)"));
  ASSERT_EQ(problems.size(), kMaxProblems + 1);
  EXPECT_EQ(problems.back(), "and more: the rest of the file was not checked");
}

// A linear search through all keys for each of them would take minutes.
TEST(SceneReader, RefusesAnObjectOfVeryManyKeys) {
  constexpr int kKeys = 300'000;
  std::string text = R"({"format": "substep-scene")";
  for (int i = 0; i < kKeys; ++i) text += ", \"k" + std::to_string(i) + "\": 0";
  const List problems = problems_of(text + ", \"k77\": 1}");
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front(), "/k77: the key occurs twice in this object");
}

TEST(SceneReader, ReadingInPartsGivesTheSameScene) {
  const auto text_of = [](int balls, double last_mass) {
    std::string bodies;
    for (int i = 0; i < balls; ++i) {
      bodies += std::string(i == 0 ? "" : ", ") + R"({"name": "b)" + std::to_string(i) +
                R"(", "shape": {"type": "sphere", "radius": 0.1}, "position": [0, 0, )" +
                std::to_string(i) + R"(], "mass": )" +
                std::to_string(i + 1 == balls ? last_mass : 1.0) + "}";
    }
    return R"({"format": "substep-scene", "version": 1, "name": "row", "title": "Row", )"
           R"("bodies": [)" +
           bodies + "]}";
  };
  const std::string good = text_of(4500, 2.0);
  SceneReading reading(good);
  int parts = 1;
  while (reading.advance()) ++parts;
  EXPECT_GE(parts, 5);
  const SceneResult result = reading.result();
  ASSERT_TRUE(result.scene);
  EXPECT_EQ(write_scene(*result.scene), write_scene(*read_scene(good).scene));
  EXPECT_EQ(result.scene->bodies.size(), 4500U);
  EXPECT_EQ(problems_of(text_of(2500, -1.0)),
            List{"/bodies/2499/mass: must be at least 1e-30 (kg), not -1"});
}

/// The valid scene with a slider instead of its hinge.
std::string with_slider(const std::string& across, const std::string& anchor_b) {
  const std::size_t begin = kGood.find(R"({"name": "hinge")");
  const std::size_t end = kGood.find("},", begin);
  std::string text = kGood;
  return text.replace(begin, end - begin,
                      R"({"name": "slider", "type": "prismatic", "a": "arm", "b": "world", )"
                      R"("anchor_a": [-0.5, 0, 0], "anchor_b": )" +
                          anchor_b + R"(, "axis_a": [0, 1, 0], "axis_b": [0, 1, 0], "across_a": )" +
                          across + R"(, "across_b": [0, 0, 1], "angular_compliance": 1e-6)");
}

TEST(SceneReader, ReadsAPrismaticJointAndWritesItBack) {
  const SceneResult result = read_scene(with_slider("[0, 0, 1]", "[-0.5, 1, 0]"));
  ASSERT_TRUE(result.scene) << to_string(result.problems.front());
  const auto& slider = std::get<PrismaticJoint>(result.scene->joints[0]);
  EXPECT_EQ(slider.across_b, Vec3::UnitZ());
  EXPECT_EQ(slider.angular_compliance, 1e-6);
  const std::string text = write_scene(*result.scene);
  EXPECT_EQ(write_scene(*read_scene(text).scene), text);
}

TEST(SceneReader, RefusesAPrismaticJointThatIsOffItsAxisOrHasNone) {
  EXPECT_EQ(problems_of(with_slider("[0, 0.6, 0.8]", "[-0.5, 3, 0]")),
            List{"/joints/0/across_a: must be perpendicular to the axis: the cosine of their angle "
                 "is 0.6, "
                 "which is more than 1e-6"});
  EXPECT_EQ(problems_of(with_slider("[0, 0, 1]", "[-0.5, 3, 0.5]")),
            List{"/joints/0: the anchors start 0.5 apart, which is more than 0.1 (m)"});
  EXPECT_EQ(problems_of(with_slider("[1, 0, 0]", "[-0.5, 3, 0]")),
            List{"/joints/0: the directions across the axes start at an angle with sine 1, which "
                 "is more than 0.1"});
}

/// The valid scene with another joint instead of its hinge. @param rest its keys beyond the anchors
std::string with_joint(const std::string& type, const std::string& rest) {
  const std::size_t begin = kGood.find(R"({"name": "hinge")");
  const std::size_t end = kGood.find("},", begin);
  std::string text = kGood;
  return text.replace(begin, end - begin,
                      R"({"name": "joint", "type": ")" + type +
                          R"(", "a": "arm", "b": "world", "anchor_a": [-0.5, 0, 0], )"
                          R"("anchor_b": [-0.5, 3, 0], )" +
                          rest);
}

TEST(SceneReader, ReadsUniversalAndCylindricalJointsAndWritesThemBack) {
  const std::string pins = R"("axis_a": [1, 0, 0], "axis_b": [0, 0, 1])";
  const SceneResult cross =
      read_scene(with_joint("universal", pins + R"(, "angular_compliance": 1e-6)"));
  ASSERT_TRUE(cross.scene) << to_string(cross.problems.front());
  EXPECT_EQ(std::get<UniversalJoint>(cross.scene->joints[0]).axis_b, Vec3::UnitZ());
  EXPECT_EQ(std::get<UniversalJoint>(cross.scene->joints[0]).angular_compliance, 1e-6);
  const std::string axes = R"("axis_a": [1, 0, 0], "axis_b": [1, 0, 0])";
  std::string text =
      with_joint("cylindrical", axes + R"(, "limit": {"lower": -1, "upper": 2}, "friction": 3)");
  const std::string effects = R"("joints", )";
  text.replace(text.find(effects), effects.size(), R"("joints", "limits", "joint_friction", )");
  const SceneResult cylinder = read_scene(text);
  ASSERT_TRUE(cylinder.scene) << to_string(cylinder.problems.front());
  EXPECT_EQ(std::get<CylindricalJoint>(cylinder.scene->joints[0]).limit->upper, 2.0);
  for (const SceneResult* result : {&cross, &cylinder}) {
    const std::string written = write_scene(*result->scene);
    EXPECT_EQ(write_scene(*read_scene(written).scene), written);
  }
}

TEST(SceneReader, ReadsARopeAndRefusesOneThatIsTooShortOrStretches) {
  const auto with_rope = [](const std::string& rest) {
    std::string text = with_joint("rope", rest);
    const std::string effects = R"("joints", )";
    return text.replace(text.find(effects), effects.size(), R"("joints", "limits", )");
  };
  const SceneResult read = read_scene(with_rope(R"("length": 0.5)"));
  ASSERT_TRUE(read.scene) << to_string(read.problems.front());
  EXPECT_EQ(std::get<RopeJoint>(read.scene->joints[0]).limit->upper, 0.5);
  const std::string written = write_scene(*read.scene);
  EXPECT_EQ(write_scene(*read_scene(written).scene), written);
  EXPECT_EQ(problems_of(with_rope(R"("length": 1, "compliance": 1e-6)")),
            List{"/joints/0/compliance: a rope does not stretch: it must be 0, not 1e-6"});
  std::string apart = with_rope(R"("length": 0.5)");
  const std::string anchor = R"("anchor_b": [-0.5, 3, 0])";
  apart.replace(apart.find(anchor), anchor.size(), R"("anchor_b": [-0.5, 3, 1])");
  EXPECT_EQ(problems_of(apart), List{"/joints/0: the anchors start 0.5 beyond the length of their "
                                     "rope, which is more than 0.1 (m)"});
}

TEST(SceneReader, RefusesUniversalAndCylindricalJointsWithTheWrongAxesOrKeys) {
  EXPECT_EQ(problems_of(with_joint("universal", R"("axis_a": [0, 0.6, 0.8], "axis_b": [0, 0, 1])")),
            List{"/joints/0: the axes start at an angle with cosine 0.8, which is more than 0.1"});
  EXPECT_EQ(problems_of(with_joint("cylindrical", R"("axis_a": [0, 1, 0], "axis_b": [0, 0, 1])")),
            List{"/joints/0: the axes start at an angle with sine 1, which is more than 0.1"});
  EXPECT_EQ(
      problems_of(with_joint("universal", R"("axis_a": [1, 0, 0], "axis_b": [0, 0, 1], )"
                                          R"("friction": 1)")),
      List{"/joints/0/friction: unknown key (known here: name, type, a, b, anchor_a, anchor_b, "
           "compliance, axis_a, axis_b or angular_compliance)"});
}

TEST(SceneReader, NeedsABodyButNoneThatMoves) {
  EXPECT_EQ(problems_of(R"({"format": "substep-scene", "version": 1, "name": "a", "title": "A",
                            "bodies": []})"),
            List{"/bodies: must have at least one body"});
  EXPECT_EQ(problems_of(R"({"format": "substep-scene", "version": 1, "name": "a", "title": "A",
                            "bodies": [{"name": "floor", "static": true, "position": [0, 0, 0],
                                        "shape": {"type": "plane"}}]})"),
            List{});
}

TEST(SceneReader, ReportsThatAFileCannotBeRead) {
  for (const char* path : {"/no/such/scene.json", "/"}) {
    const SceneResult result = read_scene_file(path);
    EXPECT_EQ(result.scene, nullptr);
    ASSERT_EQ(result.problems.size(), 1U);
    EXPECT_EQ(result.problems[0].message.find("cannot read " + std::string(path) + ": "), 0U)
        << result.problems[0].message;
  }
}

TEST(SceneReader, NeverCrashesOnADamagedFile) {
  // Each byte in turn is removed, and replaced with a few characters that have a meaning in JSON.
  for (std::size_t i = 0; i < kGood.size(); ++i) {
    read_scene(kGood.substr(0, i));
    std::string text = kGood;
    for (const char c : {'"', '{', ']', '-', '9', 'e', '\\'}) {
      text[i] = c;
      const SceneResult result = read_scene(text);
      EXPECT_EQ(result.scene == nullptr, !result.problems.empty());
    }
  }
}

TEST(SceneReader, AcceptsRedundantStiffJointsWithRegularisation) {
  const std::string text = with(R"("frame": 0.01)", R"("regularisation": 1e-6)",
                                with(R"("compliance": 1e-9)", R"("compliance": 0)"));
  EXPECT_EQ(problems_of(text), List{});
}

TEST(SceneReader, DerivesEffectsThatAreNotListed) {
  const std::string unlisted =
      with(R"("effects": ["gravity", "joints", "contact", "friction"],)", "");
  const auto scene = read_scene(unlisted).scene;
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(
      scene->effects,
      (Effects{
          .gravity = true, .gyroscopic = true, .joints = true, .contact = true, .friction = true}));
  const auto ball =
      read_scene(R"({"format": "substep-scene", "version": 1, "name": "a", "title": "A",
      "gravity": [0, 0, 0], "bodies": [{"name": "ball", "shape": {"type": "sphere", "radius": 1},
      "mass": 1, "position": [0, 0, 0], "friction": 1}]})")
          .scene;
  ASSERT_NE(ball, nullptr);
  EXPECT_EQ(ball->effects, Effects{});
}

TEST(SceneReader, InfersExternalForcesFromBodies) {
  const std::string unlisted =
      with(R"("effects": ["gravity", "joints", "contact", "friction"],)", "");
  EXPECT_FALSE(read_scene(unlisted).scene->effects.external);
  for (const char* key : {R"("force": [0, 0, 2], )", R"("torque": [0, -1, 0], )"}) {
    const SceneResult pushed =
        read_scene(with(R"("shape": {"type": "sphere")",
                        std::string(key) + R"("shape": {"type": "sphere")", unlisted));
    ASSERT_NE(pushed.scene, nullptr);
    EXPECT_TRUE(pushed.scene->effects.external);
  }
}

TEST(SceneReader, RefusesAnInconsistentStartUnderPolicyRefuse) {
  // The ball is 5 cm too far and moves at 2 m/s; the arm rotates at 3 rad/s across its hinge's
  // axis.
  const std::string apart =
      with(R"("position": [1, 3, 0])", R"("position": [1.05, 3, 0], "velocity": [0, 2, 0])");
  const std::string turning =
      with(R"("velocity": [0, 0, 0], )",
           R"("velocity": [0, 0, 0], "angular_velocity": [3, 0, 0], )", apart);
  const auto with_start = [](const std::string& start, const std::string& text) {
    return with(R"("frame": 0.01,)", R"("frame": 0.01, "start": ")" + start + R"(",)", text);
  };
  for (const char* start : {"project", "keep"}) {
    const SceneResult read = read_scene(with_start(start, turning));
    ASSERT_NE(read.scene, nullptr);
    EXPECT_EQ(name_of(read.scene->start), start);
    EXPECT_EQ(read.scene->bodies[2].position, Vec3(1.05, 3.0, 0.0)) << "as it is written";
  }
  EXPECT_EQ(problems_of(with_start("refuse", kGood)), List{});
  EXPECT_EQ(problems_of(with_start("refuse", turning)),
            (List{"/joints/0: \"start\" is \"refuse\", and this joint is rotating across its axis "
                  "at 3 rad/s",
                  "/joints/1: \"start\" is \"refuse\", and this joint is open by 5 cm, moving "
                  "apart at 2 m/s"}));
  EXPECT_EQ(problems_of(with_start("mend", kGood)),
            List{"/start: must be project, keep or refuse, not \"mend\""});
  EXPECT_EQ(problems_of(with(R"("position": [1, 3, 0])", R"("position": [1.25, 3, 0])")),
            List{"/joints/1: the anchors start 0.25 apart, which is more than 0.1 (m)"})
      << "for every start policy";
}

TEST(SceneReader, LeavesOrientationsAsTheyAreWritten) {
  const auto scene = read_scene(with("[1, 0, 0, 0]", "[0.9999995, 0, 0, 0]")).scene;
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->bodies[1].orientation.w(), 0.9999995);
}

TEST(SceneReader, DerivesAMissingInertiaFromTheShape) {
  const auto scene = read_scene(kGood).scene;
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->bodies[1].inertia, Vec3(0.1, 0.2, 0.2));
  EXPECT_EQ(scene->bodies[2].inertia, solid_inertia(Sphere{0.5}, 1.0));
}

}  // namespace
}  // namespace substep
