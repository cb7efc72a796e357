// The cost of each effect, measured in the window.

#include <gtest/gtest.h>

#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

/// Half a second of the bridge: rows of every kind.
std::shared_ptr<const Scene> short_bridge() {
  Scene scene = *shipped("bridge");
  scene.criteria.duration = 0.5;
  return std::make_shared<const Scene>(std::move(scene));
}

TEST(EffectCosts, SlicesGiveTheResultOfOneCall) {
  Headless h;
  h.app->run(short_bridge());
  h.app->session.pause();
  h.app->set("panel", "accuracy");
  h.frames(3);
  h.press("Stages");
  EXPECT_FALSE(h.app->accuracy.effects.running()) << "nothing runs without a request";
  h.press("Measure this run");
  ASSERT_TRUE(h.app->accuracy.effects.running());
  finish_costs(h);
  const CostBreakdown* sliced = h.app->costs();
  ASSERT_NE(sliced, nullptr);
  const CostBreakdown whole =
      cost_of_effects(*h.app->plain_scene, *h.app->accuracy.effects.experiment());
  EXPECT_EQ(sliced->run.work, whole.run.work);
  EXPECT_EQ(sliced->run.work.frames, 30);
  ASSERT_EQ(sliced->effects.size(), whole.effects.size());
  for (std::size_t i = 0; i < whole.effects.size(); ++i) {
    EXPECT_EQ(sliced->effects[i].effect, whole.effects[i].effect);
    EXPECT_EQ(sliced->effects[i].flops, whole.effects[i].flops);
    EXPECT_NE(find_handle(whole.effects[i].effect), nullptr) << "each has its bar";
  }
  EXPECT_NE(find_handle("criterion"), nullptr);
}

// As for the alpha search: a running measurement is visible and can be cancelled from any panel.
TEST(EffectCosts, ARunningSweepIsShownBesideThem) {
  Headless h;
  h.app->open("swinging_box");  // its sweep takes a minute, so it is still running
  h.app->session.pause();
  h.app->set("panel", "accuracy");
  h.app->set("accuracy", "stages");
  h.frames(3);
  EXPECT_EQ(find_handle("Cancel"), nullptr);
  h.app->set("accuracy", "run");
  h.frames(2);
  EXPECT_NE(find_handle("Measure this run"), nullptr);
  h.press("Cancel");
  EXPECT_FALSE(h.app->accuracy.running());
  EXPECT_EQ(find_handle("Cancel"), nullptr);
  EXPECT_EQ(find_handle("Run it again"), nullptr) << "a sweep begins beside its picture";
}

TEST(EffectCosts, SlicesAreBoundedAndResultsBelongToTheirSettings) {
  Headless h;
  h.app->open("swinging_box");
  h.app->session.pause();
  ASSERT_EQ(h.app->set("accuracy", "measure"), "");
  for (int i = 0; i < 12; ++i) {
    h.app->accuracy.advance(1e-9);  // one frame of one simulator at most
    EXPECT_LE(h.app->accuracy.effects.progress(), (i + 3.0) / 3.0 / 600.0);
  }
  EXPECT_GT(h.app->accuracy.effects.progress(), 0.0);
  EXPECT_NE(h.app->costs(), nullptr) << "partial results are shown";
  h.app->set("alpha", "0.2");
  EXPECT_EQ(h.app->costs(), nullptr) << "of other settings";
  h.app->set("alpha", "0.1");
  EXPECT_NE(h.app->costs(), nullptr);
  ASSERT_EQ(h.app->set("accuracy", "cancel"), "");
  const double share = h.app->accuracy.effects.progress();
  h.frames(5);
  EXPECT_EQ(h.app->accuracy.effects.progress(), share);
  h.app->open("pendulum");
  EXPECT_EQ(h.app->costs(), nullptr) << "of another scene";
}

TEST(EffectCosts, SwitchesMeasureTheirOwn) {
  Headless h(1280.0F, 1400.0F);
  h.app->run(short_bridge());
  h.app->session.pause();
  h.app->session.step();
  h.app->desk.more = true;
  h.frames(3);
  h.press("Measure cost per effect");
  finish_costs(h);
  ASSERT_NE(h.app->costs(), nullptr);
  h.frames(2);
  EXPECT_EQ(find_handle("Measure cost per effect"), nullptr) << "the costs are known";
  h.press("friction");
  EXPECT_FALSE(h.app->session.scene().effects.friction);
  h.press("friction");
  EXPECT_TRUE(h.app->session.scene().effects.friction);
}

}  // namespace
}  // namespace substep
