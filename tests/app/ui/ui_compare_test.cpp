#include "app/lab/compare.hpp"

#include <gtest/gtest.h>

#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

std::uint64_t hash_of(const Compare::Run& run) { return state_hash(run.simulator->state()); }

TEST(Compare, EachRunsAsItWouldAlone) {
  Headless h;
  h.app->open_link("scene=swinging_box&compare=mode:damping;solver:pgs,drift:soft");
  ASSERT_EQ(h.app->compare.runs().size(), 2U);
  for (int i = 0; i < 60; ++i) h.app->session.step();
  for (std::size_t i = 0; i < 2; ++i) {
    Session alone(shipped("swinging_box"));
    alone.set_settings(
        Compare::settings_of(h.app->compare.runs()[i].overrides, alone.scene().settings));
    for (int f = 0; f < 60; ++f) alone.step();
    EXPECT_EQ(hash_of(h.app->compare.runs()[i]), alone.hash()) << i;
    EXPECT_EQ(h.app->compare.runs()[i].history.size(), 60U);
  }
}

TEST(Compare, TheSameMethodNeverDiverges) {
  Headless h;
  h.app->compare.start(h.app->session, {Overrides{}});
  for (int i = 0; i < 120; ++i) h.app->session.step();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), h.app->session.hash());
  EXPECT_FALSE(h.app->compare.runs()[0].divergence.has_value());
  EXPECT_EQ(h.app->compare.runs()[0].cost.substeps, h.app->compare.cost(h.app->session).substeps);
}

TEST(Compare, ARunWithoutSubstepsDivergesAndFails) {
  Headless h;
  h.app->open_link("scene=swinging_box&mode=adaptive&compare=mode:none");
  for (int i = 0; i < 60; ++i) h.app->session.step();
  const Compare::Run& none = h.app->compare.runs()[0];
  ASSERT_TRUE(none.divergence.has_value());
  EXPECT_GT(none.divergence->distance, Compare::kThreshold);
  EXPECT_LT(none.divergence->time, 0.5);
  EXPECT_FALSE(none.verdict->holds());
  EXPECT_TRUE(h.app->session.verdict().holds());
  EXPECT_LT(none.cost.substeps, h.app->compare.cost(h.app->session).substeps);
  h.frames(2);
  EXPECT_FALSE(h.renderer->picture.ghost_boxes.empty());
}

TEST(Compare, SettingsOfTheRunApplyToTheOthersUnlessOverridden) {
  Headless h;
  h.app->open_link("scene=swinging_box&compare=mode:damping");
  ASSERT_EQ(h.app->set("alpha", "0.3"), "");
  ASSERT_EQ(h.app->set("mode", "const"), "");
  h.frames(2);
  const Settings& other = h.app->compare.runs()[0].simulator->settings();
  EXPECT_EQ(other.alpha, 0.3);
  EXPECT_EQ(other.mode, Mode::kDamping);
}

TEST(Compare, ResetRestartsAllOfThem) {
  Headless h;
  h.app->open_link("scene=bridge&compare=mode:damping");
  for (int i = 0; i < 40; ++i) h.app->session.step();
  const std::uint64_t first = hash_of(h.app->compare.runs()[0]);
  h.app->reset();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), h.app->session.hash());
  EXPECT_EQ(h.app->compare.cost(h.app->session).substeps, 0);
  for (int i = 0; i < 40; ++i) h.app->session.step();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), first);
}

TEST(Compare, ALinkRestoresIt) {
  Headless h;
  h.app->open_link("scene=bridge&mode=adaptive&compare=mode:none;solver:pgs,alpha:0.2");
  EXPECT_TRUE(h.app->trouble.title.empty());
  const std::string link = h.app->link();
  EXPECT_NE(link.find("&compare=mode:none;solver:pgs,alpha:0.2"), std::string::npos) << link;
  h.app->open("pendulum");
  EXPECT_FALSE(h.app->compare.open());
  h.app->open_link(link);
  EXPECT_EQ(h.app->link(), link);
}

TEST(Compare, InvalidOverridesAreReported) {
  Headless h;
  EXPECT_NE(h.app->set("compare", "mode:warp"), "");
  EXPECT_NE(h.app->set("compare", "speed:2"), "");
  EXPECT_NE(h.app->set("compare", "n:1;n:2;n:3;n:4"), "");
  EXPECT_EQ(h.app->compare.runs().size(), kMostCompared);
  EXPECT_EQ(h.app->set("compare", "off"), "");
  EXPECT_FALSE(h.app->compare.open());
}

TEST(Compare, InvalidOverridesAddNoRun) {
  Headless h;
  h.app->open_link("#scene=bridge&compare=mode:const;nothing:3;same");
  EXPECT_FALSE(h.app->trouble.title.empty());
  ASSERT_EQ(h.app->compare.runs().size(), 2U);
  EXPECT_TRUE(h.app->compare.runs()[1].overrides.empty());
  const std::string link = h.app->link();
  EXPECT_TRUE(link.ends_with("&compare=mode:const;same")) << link;
  h.app->trouble = {};
  h.app->open_link(link);
  EXPECT_TRUE(h.app->trouble.title.empty());
  EXPECT_EQ(h.app->link(), link);
  h.app->open_link("#scene=bridge&compare=nothing:3");
  EXPECT_FALSE(h.app->compare.open());
}

TEST(Compare, SolversAreCalledByTheirNames) {
  EXPECT_EQ(overrides_title({{"solver", "newton"}, {"mode", "none"}}, PaperSettings{}),
            "Newton, none");
  EXPECT_EQ(overrides_title({{"solver", "xpbd"}}, PaperSettings{}), "XPBD");
  EXPECT_EQ(overrides_title({{"mode", "const"}, {"n", "6"}}, PaperSettings{}), "constant 6");
  EXPECT_EQ(overrides_title({{"mode", "const"}}, PaperSettings{}), "const");
  EXPECT_EQ(overrides_title({{"mode", "damping"}, {"n", "6"}}, PaperSettings{}), "damping");
}

TEST(Compare, TitlesNameOnlyWhatARunReads) {
  Headless h;
  h.app->compare.start(h.app->session,
                       {{{"mode", "const"}, {"n", "6"}, {"integrator", "leapfrog"}}});
  EXPECT_EQ(ui::run_title(h.app->session, h.app->compare), "adaptive, Euler (this run)");
}

// The compared run has the session's own method: after every action on both they must agree bit for
// bit, also after going back and forth in time.
TEST(Compare, AGrabAndABallAffectAllOfThem) {
  Headless h;
  Session& session = h.app->session;
  h.app->open_link("scene=bridge&mode=const&n=2&compare=mode:const;mode:damping");
  h.app->compare.past_failure = true;  // the hand may tear the bridge
  const Compare::Run& same = h.app->compare.runs()[0];
  for (int i = 0; i < 20; ++i) session.step();
  const Vec3 target = session.state().x[3] + Vec3(0.0, 1.0, 0.5);
  session.grab(3, Vec3::Zero(), target);
  for (int i = 0; i < 10; ++i) {
    session.pull_to(target + 0.02 * i * Vec3::UnitY());
    session.step();
  }
  session.let_go();
  EXPECT_EQ(hash_of(same), session.hash());
  const std::uint64_t pulled = session.hash();
  Ball ball;
  ball.position = Vec3(0.0, 6.0, 0.0);
  ball.velocity = Vec3(0.0, -3.0, 0.0);
  session.throw_ball(ball);
  const Compare::Run& damped = h.app->compare.runs()[1];
  EXPECT_EQ(same.simulator->state().x.size(), session.state().x.size()) << "at once";
  EXPECT_TRUE(damped.verdict->disturbed());
  for (int i = 0; i < 45; ++i) session.step();
  EXPECT_EQ(hash_of(same), session.hash());
  EXPECT_NE(hash_of(damped), session.hash());
  EXPECT_EQ(damped.simulator->state().x.size(), session.state().x.size());
  EXPECT_FALSE(same.divergence);
  h.frames(2);

  // Back to before the ball and the grab, and forward through both again.
  const std::uint64_t thrown = session.hash();
  const std::uint64_t damped_thrown = hash_of(damped);
  for (const std::size_t moment : {std::size_t{30}, std::size_t{12}, std::size_t{75}}) {
    session.go_to(moment);
    h.frames(2);
    EXPECT_EQ(hash_of(same), session.hash()) << moment;
  }
  EXPECT_EQ(session.hash(), thrown);
  EXPECT_EQ(hash_of(damped), damped_thrown);

  // A different future from the same moment: the earlier ball is not in it.
  session.go_to(30);
  EXPECT_EQ(session.hash(), pulled);
  session.pause();
  session.set_effects(session.scene().effects);
  session.play();
  h.frames(1);
  for (int i = 0; i < 20; ++i) session.advance(kFrame);
  EXPECT_EQ(session.balls(), 0U);
  EXPECT_EQ(hash_of(same), session.hash());
}

TEST(Compare, AnEffectSwitchedOffIsOffInAllOfThem) {
  Headless h;
  Session& session = h.app->session;
  h.app->open_link("scene=bridge&mode=const&n=2&compare=mode:const");
  for (int i = 0; i < 5; ++i) session.step();
  Effects effects = session.scene().effects;
  effects.gravity = false;
  session.set_effects(effects);
  for (int i = 0; i < 10; ++i) session.step();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), session.hash());
  h.frames(1);
  EXPECT_EQ(h.app->compare.runs()[0].history.size(), 15U) << "earlier samples are kept";
}

// A point of the world in the clip space of a pane's picture, as shares of the window.
ImVec2 seen_at(const Picture& picture, const Vec3& x) {
  const Eigen::Vector4f p = picture.view_projection * x.cast<float>().homogeneous();
  return {0.5F + 0.5F * p.x() / p.w(), 0.5F - 0.5F * p.y() / p.w()};
}

TEST(CompareSplit, EachRunHasItsOwnPane) {
  for (const ImVec2 display :
       {ImVec2(1280, 720), ImVec2(1920, 1080), ImVec2(390, 844), ImVec2(844, 390)}) {
    for (const char* others :
         {"mode:none", "mode:none;mode:damping", "mode:none;mode:damping;solver:pgs"}) {
      Headless h(display.x, display.y);
      h.app->open_link(std::string("scene=swinging_box&compare=") + others);
      ASSERT_EQ(h.app->set("views", "split"), "");
      h.frames(3);
      const std::size_t count = 1 + h.app->compare.runs().size();
      ASSERT_EQ(h.app->panes.size(), count);
      ASSERT_EQ(h.renderer->pictures.size(), count);
      const ViewRect& v = h.app->view_rect;
      float area = 0.0F;
      for (std::size_t i = 0; i < count; ++i) {
        const ViewRect& r = h.app->panes[i];
        EXPECT_GE(r.x, v.x - 0.5F);
        EXPECT_LE(r.x + r.width, v.x + v.width + 0.5F);
        EXPECT_LE(r.y + r.height, v.y + v.height + 0.5F);
        area += r.width * r.height;
        // The camera's target is at the centre of each pane: the camera is shared.
        const ImVec2 middle = seen_at(h.renderer->pictures[i], h.app->view.camera.target());
        EXPECT_NEAR(middle.x * display.x, r.x + 0.5F * r.width, 1.0F);
        EXPECT_NEAR(middle.y * display.y, r.y + 0.5F * r.height, 1.0F);
        EXPECT_TRUE(h.renderer->pictures[i].ghost_boxes.empty());
        EXPECT_EQ(h.renderer->pictures[i].boxes.size(), h.renderer->pictures[0].boxes.size());
      }
      EXPECT_GT(area, 0.75F * v.width * v.height) << "the panes fill the view";
      ASSERT_EQ(h.app->set("views", "ghosts"), "");
      h.frames(1);
      EXPECT_EQ(h.renderer->pictures.size(), 1U);
      EXPECT_FALSE(h.renderer->picture.ghost_boxes.empty());
    }
  }
}

TEST(CompareSplit, PanesOfAWideSceneAreStacked) {
  Headless phone(390.0F, 844.0F);
  phone.app->open_link("scene=bridge&compare=mode:damping&views=split");
  phone.frames(2);
  ASSERT_EQ(phone.app->panes.size(), 2U);
  EXPECT_GT(phone.app->panes[1].y, phone.app->panes[0].y) << "one above the other";
}

TEST(CompareSplit, ABodyIsPulledInThePaneThatShowsIt) {
  Headless h;
  h.app->open_link("scene=swinging_box&mode=const&n=12&compare=mode:damping&views=split");
  h.app->session.play();
  h.frames(40);
  const int box = static_cast<int>(h.app->session.scene().bodies.size()) - 1;
  const Compare::Run& other = h.app->compare.runs()[0];
  ImVec2 p;
  ASSERT_TRUE(ui::project(*h.app, other.poses.x[static_cast<std::size_t>(box)], p, 1));
  ImGuiIO& io = ImGui::GetIO();
  io.AddMousePosEvent(p.x, p.y);
  h.frames(1);
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  for (int i = 0; i < 10; ++i) {
    io.AddMousePosEvent(p.x, p.y - 4.0F * static_cast<float>(i));
    h.frames(1);
  }
  h.frames(1);  // the frame computed with the pointer at its current position
  ASSERT_TRUE(h.app->session.held());
  EXPECT_EQ(h.app->session.held()->body, box);
  ASSERT_TRUE(other.simulator->grab());
  EXPECT_EQ(other.simulator->grab()->target, h.app->session.held()->target);
  ImVec2 hand;
  ASSERT_TRUE(ui::project(*h.app, h.app->session.held()->target, hand, 1));
  EXPECT_NEAR(hand.y, p.y - 36.0F, 8.0F) << "the hand is where the pointer is in that pane";
  io.AddMouseButtonEvent(0, false);
  h.frames(2);
  EXPECT_FALSE(other.simulator->grab());
}

TEST(CompareSplit, AKeyChangesTheViews) {
  Headless h;
  h.app->open_link("scene=bridge&compare=mode:damping");
  h.type("v");
  EXPECT_EQ(h.app->panes.size(), 2U);
  h.type("v");
  EXPECT_EQ(h.app->panes.size(), 1U);
}

TEST(Compare, EveryPanelIsDrawnWithIt) {
  for (const float width : {1280.0F, 390.0F}) {
    Headless h(width, width > 900.0F ? 720.0F : 844.0F);
    h.app->open_link("scene=heavy_stack&compare=mode:none;mode:damping;solver:pgs");
    h.app->session.play();
    for (const char* panel : {"controls", "plots", "why", "compare"}) {
      ASSERT_EQ(h.app->set("panel", panel), "");
      h.frames(10);
    }
    h.app->desk.compare_open = 1;
    h.frames(3);
    for (const Compare::Run& run : h.app->compare.runs()) {
      if (!run.verdict->holds()) continue;  // it ends where it failed
      EXPECT_EQ(run.history.size(), h.app->session.history().size());
    }
    EXPECT_TRUE(h.app->compare.runs()[1].verdict->holds());
  }
}

}  // namespace
}  // namespace substep
