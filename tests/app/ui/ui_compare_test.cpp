#include "app/compare.hpp"

#include <gtest/gtest.h>

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

TEST(Compare, TheSameMethodNeverParts) {
  Headless h;
  h.app->compare.start(h.app->session, {Overrides{}});
  for (int i = 0; i < 120; ++i) h.app->session.step();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), h.app->session.hash());
  EXPECT_FALSE(h.app->compare.runs()[0].divergence.has_value());
  EXPECT_EQ(h.app->compare.runs()[0].cost.substeps, h.app->compare.cost().substeps);
}

TEST(Compare, ARunWithoutSubstepsPartsAndFails) {
  Headless h;
  h.app->open_link("scene=swinging_box&mode=adaptive&compare=mode:none");
  for (int i = 0; i < 60; ++i) h.app->session.step();
  const Compare::Run& none = h.app->compare.runs()[0];
  ASSERT_TRUE(none.divergence.has_value());
  EXPECT_GT(none.divergence->distance, Compare::kThreshold);
  EXPECT_LT(none.divergence->time, 0.5);
  EXPECT_FALSE(none.verdict->holds());
  EXPECT_TRUE(h.app->session.verdict().holds());
  EXPECT_LT(none.cost.substeps, h.app->compare.cost().substeps);
  h.frames(2);
  EXPECT_FALSE(h.renderer->picture.ghost_boxes.empty());
}

TEST(Compare, SettingsOfTheRunReachTheOthersWhereTheyDoNotDiffer) {
  Headless h;
  h.app->open_link("scene=swinging_box&compare=mode:damping");
  ASSERT_EQ(h.app->set("alpha", "0.3"), "");
  ASSERT_EQ(h.app->set("mode", "const"), "");
  h.frames(2);
  const Settings& other = h.app->compare.runs()[0].simulator->settings();
  EXPECT_EQ(other.alpha, 0.3);
  EXPECT_EQ(other.mode, Mode::kDamping);
}

TEST(Compare, ResetStartsAllOfThemAnew) {
  Headless h;
  h.app->open_link("scene=bridge&compare=mode:damping");
  for (int i = 0; i < 40; ++i) h.app->session.step();
  const std::uint64_t first = hash_of(h.app->compare.runs()[0]);
  h.app->reset();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), h.app->session.hash());
  EXPECT_EQ(h.app->compare.cost().substeps, 0);
  for (int i = 0; i < 40; ++i) h.app->session.step();
  EXPECT_EQ(hash_of(h.app->compare.runs()[0]), first);
}

TEST(Compare, LinkBringsItBack) {
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

TEST(Compare, WhatCannotBeReadIsTold) {
  Headless h;
  EXPECT_NE(h.app->set("compare", "mode:warp"), "");
  EXPECT_NE(h.app->set("compare", "speed:2"), "");
  EXPECT_NE(h.app->set("compare", "n:1;n:2;n:3;n:4"), "");
  EXPECT_EQ(h.app->compare.runs().size(), Compare::kMost);
  EXPECT_EQ(h.app->set("compare", "off"), "");
  EXPECT_FALSE(h.app->compare.open());
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
    EXPECT_EQ(h.app->compare.runs()[2].history.size(), h.app->session.history().size());
  }
}

}  // namespace
}  // namespace substep
