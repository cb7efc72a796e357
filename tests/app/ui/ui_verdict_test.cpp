// The window's text about a run before its verdict and after a failure.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "app/text/verdict_words.hpp"
#include "app/ui/over_picture.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(VerdictWords, AgreeWithTheVerdict) {
  EXPECT_EQ(verdict_words("holds"), "Holds");
  EXPECT_EQ(verdict_words("fails at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)"),
            "Failed at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)");
  EXPECT_EQ(verdict_words("disturbed at 1.20 s"), "Disturbed at 1.20 s");
}

TEST(VerdictWords, NameTheValueTheLimitAndWhatTheyMean) {
  using What = Exceeded::What;
  EXPECT_EQ(exceeded_sentence({What::kJointGap, 0.1067, 0.1, "hinge_7"}),
            "hinge_7 has a gap of 0.107 m. Above 0.1 m a joint counts as torn.");
  EXPECT_EQ(exceeded_sentence({What::kEnergyGain, 36921.0, 5150.0, ""}),
            "The total energy has grown by 36.9 kJ. The limit is 5.15 kJ.");
  EXPECT_EQ(exceeded_sentence({What::kMoved, 0.31, 0.25, "box"}),
            "box has moved by 0.31 m. The scene allows 0.25 m.");
  EXPECT_EQ(exceeded_sentence({What::kMoved, 0.1003, 0.1, "box"}),
            "box has moved by just over 0.1 m. The scene allows 0.1 m.");
  EXPECT_EQ(exceeded_label({What::kEnergyGain, 0.05, 0.01, ""}), "energy gain 50 mJ");
}

TEST(Verdict, NothingIsShownBeforeTheFirstFrame) {
  Session session(shipped("swinging_box"));
  EXPECT_FALSE(session.judged());
  EXPECT_EQ(verdict_note(session.verdict(), session.judged()), "Ready");
  session.step();
  EXPECT_TRUE(session.judged());
  EXPECT_EQ(verdict_note(session.verdict(), session.judged()), "Holds");
  session.go_to(0);
  EXPECT_FALSE(session.judged());
  session.grab(1, Vec3::Zero(), Vec3::Zero());
  EXPECT_TRUE(session.judged()) << "a disturbance shows before the first frame";
}

Settings without_substeps(const Session& session) {
  Settings settings = session.settings();
  settings.mode = Mode::kNone;
  return settings;
}

TEST(FailedRun, PausesAtItsFailureAndContinuesOnRequest) {
  Headless h;
  h.app->run(shipped("swinging_box"));
  h.app->change(without_substeps(h.app->session));
  h.app->session.play();
  h.frames(120);
  EXPECT_FALSE(h.app->session.playing());
  EXPECT_FALSE(h.app->session.verdict().holds());
  EXPECT_EQ(h.app->session.state().time, h.app->session.verdict().failed_at());
  h.app->session.play();
  h.frames(30);
  EXPECT_TRUE(h.app->session.playing()) << "it does not fail a second time";
}

TEST(FailedRun, ContinuesBesideComparedRuns) {
  Headless h;
  h.app->run(shipped("swinging_box"));
  ASSERT_EQ(h.app->set("mode", "none"), "");
  ASSERT_EQ(h.app->set("compare", "mode:adaptive"), "");
  h.app->session.play();
  h.frames(60);
  EXPECT_FALSE(h.app->session.verdict().holds());
  EXPECT_TRUE(h.app->session.playing());
}

TEST(FailedRun, PlaysAgainFromItsStartOnlyIfItPlayed) {
  Session session(shipped("swinging_box"));
  session.set_settings(without_substeps(session));
  for (int i = 0; i < 40; ++i) session.step();
  ASSERT_FALSE(session.verdict().holds());
  session.reset();
  EXPECT_FALSE(session.playing()) << "it advanced by single frames";
  session.play();
  for (int i = 0; i < 40; ++i) session.advance(kFrame, 1.0);
  ASSERT_FALSE(session.verdict().holds());
  session.hold();
  session.reset();
  EXPECT_TRUE(session.playing());
}

TEST(FailedRun, ARunLoadedWhileThePastIsShownPlays) {
  Session session(shipped("swinging_box"));
  session.play();
  for (int i = 0; i < 40; ++i) session.advance(kFrame, 1.0);
  session.go_to(10);
  EXPECT_FALSE(session.playing());
  session.load(shipped("bridge"));
  EXPECT_TRUE(session.playing());
  session.pause();  // on request
  session.go_to(0);
  session.load(shipped("pendulum"));
  EXPECT_FALSE(session.playing());
}

// The visible centres and corners of moving bodies that lie under a window.
int covered_by(const Headless& h, const char* window) {
  const ImGuiWindow* card = ImGui::FindWindowByName(window);
  const Poses& poses = h.app->session.poses();
  int covered = 0;
  const auto look_at = [&](const Vec3& x) {
    ImVec2 p;
    if (ui::project(*h.app, x, p)) covered += card->Rect().Contains(p) ? 1 : 0;
  };
  for (std::size_t i = 0; i < h.app->session.scene().bodies.size(); ++i) {
    const Body& body = h.app->session.scene().bodies[i];
    if (body.is_static) continue;
    look_at(poses.x[i]);
    const auto* box = std::get_if<Box>(&body.shape);
    for (int corner = 0; box != nullptr && corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                      (corner & 4) != 0 ? 1 : -1);
      look_at(poses.x[i] + poses.q[i] * box->half_extents.cwiseProduct(sign));
    }
  }
  return covered;
}

TEST(FailedRun, ItsCardCoversNoBody) {
  for (const char* scene : {"swinging_box", "bridge", "wrecking_ball", "heavy_stack_stress"}) {
    Headless h;
    h.app->run(shipped(scene));
    h.app->change(without_substeps(h.app->session));
    h.app->session.play();
    h.frames(150);
    ASSERT_FALSE(h.app->session.verdict().holds()) << scene;
    EXPECT_EQ(covered_by(h, "##failure"), 0) << scene;
  }
}

}  // namespace
}  // namespace substep
