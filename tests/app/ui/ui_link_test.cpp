#include <gtest/gtest.h>

#include "app/link.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(Link, RoundTripKeepsTheExperiment) {
  Headless h;
  ASSERT_EQ(h.app->set("scene", "bridge"), "");
  ASSERT_EQ(h.app->set("solver", "pgs"), "");
  ASSERT_EQ(h.app->set("mode", "capped"), "");
  ASSERT_EQ(h.app->set("alpha", "0.037"), "");
  ASSERT_EQ(h.app->set("n_cap", "9"), "");
  ASSERT_EQ(h.app->set("integrator", "leapfrog"), "");
  const Settings wanted = h.app->session.settings();
  const std::string link = h.app->link();
  h.app->open("pendulum");
  h.app->open_link("#" + link);
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(h.app->session.settings(), wanted);
  EXPECT_EQ(h.app->link(), link);
  EXPECT_TRUE(h.app->trouble.title.empty());
}

TEST(Link, AlwaysNamesWhatPeopleAskFor) {
  const auto scene = shipped("swinging_box");
  EXPECT_EQ(make_link(*scene, scene->settings),
            "scene=swinging_box&solver=bpp&mode=adaptive&alpha=0.1&n=16&integrator=euler");
}

TEST(Link, SceneComesFirstWhereverItStands) {
  Headless h;
  h.app->open_link("mode=damping&scene=heavy_stack");
  EXPECT_EQ(h.app->session.scene().name, "heavy_stack");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);
}

TEST(Link, WhatCannotBeReadIsToldAndTheRestHolds) {
  Headless h;
  h.app->open_link("mode=warp&alpha=7&n=5&nonsense&scene=nowhere");
  EXPECT_EQ(h.app->trouble.problems.size(), 4U);
  EXPECT_EQ(h.app->session.settings().n, 5);
  EXPECT_EQ(h.app->session.scene().name, "swinging_box");
}

TEST(Link, AnyTextIsTaken) {
  for (const char* text : {"", "#", "&&&", "=", "%", "%4", "%zz=%00", "a=b=c", "\xff\xfe"}) {
    EXPECT_NO_THROW(parse_link(text)) << text;
  }
  const auto parts = parse_link("#scene=my%20scene&x");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].value, "my scene");
  EXPECT_EQ(parts[1].key, "x");
}

}  // namespace
}  // namespace substep
