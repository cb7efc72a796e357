// What a user sees of a failure: the broken joint in a ring, the camera turned to it, and a frozen
// picture.
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cmath>

#include "app/ui/over_picture.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// The swinging box without sub-steps, played until it has torn at 0.35 s and the camera rests.
struct Torn {
  Headless h;
  explicit Torn(bool still = false) {
    h.app->desk.reduced_motion = still;
    h.app->run(shipped("swinging_box"));
    h.app->set("mode", "none");
    h.frames(2);
    before = h.app->view.camera;
  }
  void fail() {
    h.app->session.play();
    h.frames(90);
    ASSERT_FALSE(h.app->session.verdict().holds());
  }
  [[nodiscard]] Vec3 eye() const { return h.app->view.camera.eye(h.app->view_rect); }
  [[nodiscard]] Vec3 eye_before() const { return before.eye(h.app->view_rect); }
  OrbitCamera before;
};

TEST(Failure, OfATornJointLiesBetweenItsAnchors) {
  Torn torn;
  torn.fail();
  const auto failure = torn.h.app->failure_in(0);
  ASSERT_TRUE(failure.has_value());
  const FrameReport& report = torn.h.app->session.report();
  EXPECT_EQ(failure->joint, report.joint_gap_joint);
  EXPECT_NEAR((failure->to - failure->from).norm(), report.joint_gap, 1e-9);
  ASSERT_TRUE(failure->exceeded.has_value());
  EXPECT_EQ(failure->exceeded->what, Exceeded::What::kJointGap);
  EXPECT_EQ(failure->exceeded->value, report.joint_gap);
  EXPECT_EQ(failure->exceeded->name, failure->name);
  EXPECT_EQ(
      failure->name,
      base(torn.h.app->session.scene().joints[static_cast<std::size_t>(failure->joint)]).name);
}

TEST(Failure, OfABodyThatMovedIsTheBody) {
  Headless h;
  h.app->run(shipped("heavy_stack_stress"));
  h.app->set("mode", "none");
  h.app->session.play();
  for (int i = 0; i < 900 && h.app->session.verdict().holds(); ++i) h.app->session.step();
  ASSERT_FALSE(h.app->session.verdict().holds());
  h.app->session.pause();
  const auto failure = h.app->failure_in(0);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->body, h.app->session.scene().criteria.displacement->body);
  ASSERT_TRUE(failure->exceeded.has_value());
  EXPECT_EQ(failure->exceeded->what, Exceeded::What::kMoved);
}

TEST(Failure, OfAStableRunIsNone) {
  Headless h;
  h.frames(30);
  EXPECT_FALSE(h.app->failure_in(0).has_value());
}

TEST(FailureCamera, TurnsToWhatFailedAndBackAtTheNextStart) {
  Torn torn;
  torn.fail();
  const auto failure = torn.h.app->failure_in(0);
  EXPECT_TRUE(torn.h.app->view.camera.at_rest());
  EXPECT_LT((torn.h.app->view.camera.target() - failure->centre()).norm(), 0.05);
  EXPECT_LT((torn.eye() - failure->centre()).norm(),
            0.8 * (torn.eye_before() - torn.before.target()).norm())
      << "closer";
  torn.h.app->reset();
  torn.h.app->session.pause();
  torn.h.frames(90);
  EXPECT_LT((torn.eye() - torn.eye_before()).norm(), 0.1);
}

TEST(FailureCamera, KeepsAViewThatTheUserMoved) {
  Torn torn;
  torn.h.app->view.camera.orbit(0.3, 0.1);
  torn.h.frames(60);
  const Vec3 chosen = torn.eye();
  torn.fail();
  EXPECT_LT((torn.eye() - chosen).norm(), 1e-3);
  torn.h.app->reset();
  torn.h.frames(5);
  EXPECT_LT((torn.eye() - chosen).norm(), 1e-3);
}

TEST(FailureCamera, KeepsAViewChosenAtTheFailure) {
  Torn torn;
  torn.fail();
  torn.h.app->view.camera.orbit(0.5, 0.0);
  torn.h.frames(60);
  const Vec3 chosen = torn.eye();
  torn.h.app->reset();
  torn.h.app->session.pause();
  torn.h.frames(60);
  EXPECT_LT((torn.eye() - chosen).norm(), 1e-3);
}

TEST(FailureCamera, DoesNotMoveWithReducedMotion) {
  Torn torn(true);
  torn.fail();
  ASSERT_TRUE(torn.h.app->failure_in(0).has_value()) << "the ring is still shown";
  EXPECT_LT((torn.eye() - torn.eye_before()).norm(), 1e-9);
}

// Vertices of a colour in the overlay, within a distance of a point of the world.
int drawn_near(const Headless& h, const Vec3& x, std::size_t pane, ImU32 color, float within) {
  ImVec2 centre;
  EXPECT_TRUE(ui::project(*h.app, x, centre, pane));
  int count = 0;
  for (const ImDrawVert& v : ImGui::GetBackgroundDrawList()->VtxBuffer) {
    count += v.col == color && std::hypot(v.pos.x - centre.x, v.pos.y - centre.y) < within ? 1 : 0;
  }
  return count;
}

TEST(FailureRing, IsAroundTheBrokenJoint) {
  Torn torn;
  torn.fail();
  const auto failure = torn.h.app->failure_in(0);
  EXPECT_GT(drawn_near(torn.h, failure->centre(), 0, torn.h.app->look.theme->orange, 100.0F), 30);
  torn.h.app->session.go_to(5);
  torn.h.frames(60);
  EXPECT_EQ(drawn_near(torn.h, failure->centre(), 0, torn.h.app->look.theme->orange, 100.0F), 0);
}

TEST(FrozenRun, FreezesWhileOthersContinue) {
  Torn torn;
  App& app = *torn.h.app;
  ASSERT_EQ(app.set("compare", "mode:adaptive;n:2,mode:const"), "");
  app.desk.split = true;
  torn.fail();
  ASSERT_TRUE(app.session.playing());
  ASSERT_TRUE(app.frozen());
  const double then = app.session.state().time;
  const std::vector<Vec3> shown = app.poses_in(0).x;
  const std::vector<Vec3> other = app.poses_in(2).x;
  ASSERT_FALSE(app.compare.runs()[1].verdict->holds());
  torn.h.frames(60);
  EXPECT_GT(app.session.state().time, then + 0.5);
  EXPECT_EQ(app.poses_in(0).x, shown);
  EXPECT_EQ(app.poses_in(2).x, other);
  const ImGuiWindow* card = ImGui::FindWindowByName("##failure");
  EXPECT_TRUE(card != nullptr && card->WasActive) << "with its remedies";
  EXPECT_TRUE(app.compare.runs()[0].verdict->holds());
  EXPECT_FALSE(app.failure_in(1).has_value());
  for (const std::size_t pane : {0U, 2U}) {
    const auto failure = app.failure_in(pane);
    ASSERT_TRUE(failure.has_value()) << pane;
    EXPECT_LT((failure->to - failure->from).norm(), 1.0) << "the gap at the failure, not after it";
    EXPECT_GT(drawn_near(torn.h, failure->centre(), pane, app.look.theme->orange, 100.0F), 30);
  }
  EXPECT_LT((torn.eye() - torn.eye_before()).norm(), 1e-6) << "one view for all";
  app.reset();
  torn.h.frames(3);
  EXPECT_FALSE(app.frozen());
  EXPECT_FALSE(app.failure_in(2).has_value());
}

TEST(FrozenRun, ABallThrownAfterwardsDoesNotMixScenes) {
  Torn torn;
  App& app = *torn.h.app;
  ASSERT_EQ(app.set("compare", "mode:adaptive"), "");
  torn.fail();
  ASSERT_TRUE(app.frozen());
  Ball ball;
  ball.position = {0.0, 3.0, 5.0};
  app.session.throw_ball(ball);
  torn.h.frames(10);
  EXPECT_EQ(app.poses_in(0).x.size(), app.scene_in(0).bodies.size());
}

}  // namespace
}  // namespace substep
