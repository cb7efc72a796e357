// Settings selected in the window.

#include <gtest/gtest.h>

#include "core/model/methods.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(Settings, ThoseThatActOnlyAtTheStartSaySo) {
  Headless h;
  h.app->open("swinging_box");
  h.app->session.pause();
  ASSERT_EQ(h.app->set("probe", "false"), "");
  EXPECT_EQ(h.app->notice.text, "") << "it has not begun";
  h.app->session.step();
  ASSERT_EQ(h.app->set("alpha", "0.2"), "");
  EXPECT_EQ(h.app->notice.text, "") << "acts live";
  ASSERT_EQ(h.app->set("probe", "true"), "");
  EXPECT_NE(h.app->notice.text.find("reset"), std::string::npos);
}

// The controls show it below the box; the caption of the picture names the active effects.
TEST(Settings, StormerIsShownAsLeapfrogWhereItIsReplaced) {
  Headless h;
  h.app->open("pendulum");
  ASSERT_EQ(h.app->set("integrator", "stormer"), "");
  const auto height = [&](const char* solver) {
    EXPECT_EQ(h.app->set("solver", solver), "");
    h.frames(3);
    const ui::Handle* below = find_handle("More");
    const ui::Handle* box = find_handle("Störmer");
    EXPECT_TRUE(below != nullptr && box != nullptr);
    return below != nullptr && box != nullptr ? below->min.y - box->max.y : 0.0F;
  };
  const float plain = height("bpp");
  EXPECT_EQ(height("pgs"), plain);
  EXPECT_GT(height("newton"), plain + 10.0F);
  EXPECT_GT(height("xpbd"), plain + 10.0F);
  ASSERT_EQ(h.app->set("integrator", "leapfrog"), "");
  EXPECT_EQ(height("newton"), plain);
}

TEST(Settings, EveryMethodOfTheTableCanBeChosen) {
  Headless h(1280.0F, 1200.0F);
  for (const SolverEntry& entry : kSolvers) {
    h.press(entry.title);
    EXPECT_EQ(h.app->session.settings().solver, entry.value) << entry.title;
  }
  for (const ModeEntry& entry : kModes) {
    h.press(entry.name);
    EXPECT_EQ(h.app->session.settings().mode, entry.value) << entry.name;
  }
  for (const IntegratorEntry& entry : kIntegrators) {
    h.press(entry.title);
    EXPECT_EQ(h.app->session.settings().integrator, entry.value) << entry.title;
  }
}

TEST(Settings, TheConeIsOfferedWhereThereIsFriction) {
  Headless h(1280.0F, 2400.0F);
  h.app->desk.more = true;
  h.app->run(shipped("sliding_box"));
  h.frames(3);
  ASSERT_NE(find_handle("cone"), nullptr);
  EXPECT_EQ(h.app->session.settings().friction_cone, FrictionCone::kBox);
  h.press("cone");
  EXPECT_EQ(h.app->session.settings().friction_cone, FrictionCone::kCone);
  EXPECT_NE(h.app->link().find("friction_cone=cone"), std::string::npos);
  h.app->run(shipped("pendulum"));
  h.frames(3);
  EXPECT_EQ(find_handle("cone"), nullptr);
}

TEST(Presets, AButtonSetsAllOfTheMethodAndTheLinkKeepsIt) {
  Headless h;
  h.app->open("bridge");
  h.app->set("solver", "pgs");
  h.app->desk.view.tint = true;
  h.frames(3);
  h.press("recommended");
  ASSERT_TRUE(h.app->session.scene().recommended.has_value());
  Settings recommended = h.app->session.scene().recommended->settings;
  recommended.watch_stiffness = true;  // display settings are kept
  EXPECT_EQ(h.app->session.settings(), recommended);
  const std::string link = h.app->link();
  h.press("paper");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  h.app->open_link(link);
  EXPECT_EQ(h.app->session.settings(), recommended);
  EXPECT_EQ(h.app->set("preset", "paper"), "");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  EXPECT_NE(h.app->set("preset", "fastest"), "");
}

}  // namespace
}  // namespace substep
