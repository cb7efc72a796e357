// A diagnosis as JSON and as a page, and a question read from JSON.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/io/diagnosis_html.hpp"
#include "core/io/diagnosis_json.hpp"
#include "core/lab/doctor_words.hpp"
#include "core/lab/experiment.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

/// A rod on a drive: its limit in MuJoCo's Euler is that of the drive, in substep there is none.
Scene driven_by(const std::string& joint) {
  SceneBuilder builder("rod");
  const int rod = builder.add_body(Box{{0.1, 0.01, 0.01}}, 1.0, {0.1, 0.0, 0.0});
  const int hinge = builder.add_hinge(rod, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.joint(hinge).name = joint;
  builder.drive(hinge, {.stiffness = 2000.0});
  builder.scene().gravity.setZero();
  return *builder.build();
}

Diagnosis asked(const Scene& scene, const char* engine, double step) {
  DoctorQuestion question;
  question.engine = engine_of(engine);
  question.step = step;
  question.runs = false;
  return diagnose(std::make_shared<const Scene>(scene), question);
}

TEST(DiagnosisText, JsonHasTheNumbersAndWhoSetsThem) {
  const Scene scene = driven_by("elbow");
  const Diagnosis d = asked(scene, "mujoco", 0.002);
  const Json json = diagnosis_json(scene, d);
  // I = m (a^2 + b^2) / 3 + m r^2 of the half extents; h < 2 sqrt(I / k).
  const double inertia = (0.1 * 0.1 + 0.01 * 0.01) / 3.0 + 0.1 * 0.1;
  EXPECT_NEAR(json["largest_step"].get<double>(), 2.0 * std::sqrt(inertia / 2000.0), 1e-9);
  EXPECT_EQ(json["joints"], Json::parse(R"([{"index": 0, "name": "elbow"}])"));
  EXPECT_EQ(json["summary"],
            "MuJoCo, integrator Euler, needs steps below 5.17 ms, set by the drive of elbow at the "
            "start");
  EXPECT_EQ(json["by_drive"], true);
  EXPECT_EQ(json["verdict"], "holds");
  ASSERT_FALSE(json["settings"].empty());
  for (const Json& setting : json["settings"]) EXPECT_NE(setting["engine"], "substep");

  const Json free = diagnosis_json(scene, asked(scene, "substep", 0.002));
  EXPECT_TRUE(free["largest_step"].is_null());
  EXPECT_TRUE(free["joints"].empty());
  EXPECT_TRUE(free["settings"].empty());
}

TEST(DiagnosisText, ADiagnosisNamesTheJointsOfGeometricStiffness) {
  SceneBuilder builder("pendulum");
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {0.0, -1.0, 0.0});
  builder.add_ball_joint(ball, kWorld, {0.0, 0.0, 0.0});
  const Scene scene = *builder.build();
  const Diagnosis d = asked(scene, "mujoco", 0.002);
  EXPECT_EQ(d.joints, std::vector<int>{0});
  EXPECT_FALSE(d.by_drive);
}

TEST(DiagnosisText, APageEscapesNames) {
  const std::string name = "<img src=x onerror=alert(1)>&\"'";
  Scene scene = driven_by(name);
  scene.name = "</title><script>alert(2)</script>";
  scene.bodies[0].name = "<b>rod</b>";
  const std::string html = diagnosis_html(scene, asked(scene, "mujoco", 0.01));
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<b>"), std::string::npos);
  EXPECT_NE(html.find("&lt;img src=x onerror=alert(1)&gt;&amp;&quot;"), std::string::npos);
  EXPECT_NE(html.find("5.17 ms"), std::string::npos);
  EXPECT_NE(html.find("fails"), std::string::npos);
}

TEST(DiagnosisText, ABadgeHasTheStepAndTheVerdict) {
  const Scene scene = driven_by("elbow");
  const std::string badge = diagnosis_badge(asked(scene, "mujoco", 0.01));
  EXPECT_TRUE(badge.starts_with("<svg "));
  EXPECT_NE(badge.find("below 5.17 ms</text>"), std::string::npos);
  EXPECT_NE(badge.find("10 ms fails</title>"), std::string::npos);
  EXPECT_NE(diagnosis_badge(asked(scene, "substep", 0.01)).find("no limit</text>"),
            std::string::npos);
}

TEST(DiagnosisText, AQuestionIsReadWithItsRanges) {
  Problems problems;
  const auto whole = read_question(
      Json::parse(R"({"engine": "drake", "step": 0.01, "held": 4, "seconds": 2, "runs": false})"),
      problems);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->engine->name, "drake");
  EXPECT_EQ(whole->step, 0.01);
  EXPECT_EQ(whole->held, 4);
  EXPECT_EQ(whole->seconds, 2.0);
  EXPECT_FALSE(whole->runs);
  EXPECT_TRUE(read_question(Json::object(), problems));
  EXPECT_TRUE(problems.empty());
  for (const char* wrong :
       {R"({"engine": "none"})", R"({"step": 0})", R"({"step": 2})", R"({"step": "1"})",
        R"({"held": 0})", R"({"held": 1.5})", R"({"held": 1001})", R"({"seconds": -1})",
        R"({"runs": 1})", R"({"stp": 0.01})", "[]", "3"}) {
    problems.clear();
    EXPECT_FALSE(read_question(Json::parse(wrong), problems)) << wrong;
    EXPECT_FALSE(problems.empty()) << wrong;
  }
}

// The run that the page shows is the one that is judged.
TEST(DiagnosisText, TheShownRunIsTheJudgedOne) {
  SceneBuilder builder("hanging");
  int above = kWorld;
  for (int i = 0; i < 3; ++i) {
    const int link =
        builder.add_body(Sphere{0.05}, i == 2 ? 100.0 : 1.0, {0.0, -0.3 - 0.3 * i, 0.0});
    builder.body(link).collides = false;
    builder.add_hinge(link, above, {0.0, -0.3 * i, 0.0}, Vec3::UnitZ());
    above = link;
  }
  const Scene scene = *builder.build();
  const double limit = asked(scene, "substep", 0.01).step;
  for (const double share : {0.9, 1.2}) {
    DoctorQuestion question;
    question.step = share * limit;
    question.seconds = 2.0;
    const Diagnosis d = diagnose(std::make_shared<const Scene>(scene), question);
    const Scene shown = scene_at_step(scene, question.step, gain_of(d, question.step));
    Simulator simulator(std::make_shared<const Scene>(shown));
    Verdict verdict(shown, simulator.state(), simulator.observe());
    for (std::int64_t i = 0; i < frames_of(shown, 2.0) && verdict.holds(); ++i) {
      const FrameReport report = simulator.step();
      verdict.add(shown, simulator.state(), report);
    }
    EXPECT_EQ(verdict.text(), d.at_step->verdict);
    EXPECT_EQ(verdict.holds(), share < 1.0);
    // What a remedy changes is there to be applied.
    const Json remedies = diagnosis_json(scene, d)["remedies"];
    bool is_changed = false;
    for (std::size_t i = 0; i < d.remedies.size(); ++i) {
      const TriedRemedy& tried = d.remedies[i];
      EXPECT_EQ(remedies[i].contains("step"), tried.text.starts_with("a step of")) << tried.text;
      EXPECT_EQ(remedies[i]["changes_model"], tried.changed != nullptr);
      EXPECT_LT(tried.shorter, question.step);
      if (tried.changed == nullptr) continue;
      is_changed = true;
      EXPECT_GE(asked(*tried.changed, "substep", 0.01).step, kSafeMargin * question.step);
    }
    EXPECT_TRUE(is_changed);
  }
}

}  // namespace
}  // namespace substep
