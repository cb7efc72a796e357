#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <map>
#include <string>

#include "app/text/introduction.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// A window with persistent storage, on a first visit.
class Visit {
 public:
  explicit Visit(float width = 1280.0F, float height = 720.0F) : h(width, height) {
    h.app->host.remember = [this](const std::string& k, const std::string& v) { kept[k] = v; };
    h.app->host.recall = [this](const std::string& k) { return kept[k]; };
    h.app->session.play();
    h.app->introduction.offer(*h.app);
    h.frames(3);
  }
  [[nodiscard]] bool open() const { return h.app->introduction.open(); }
  [[nodiscard]] const Compare::Run& torn() const { return h.app->compare.runs().at(0); }
  void press(ImGuiKey key) {
    ImGui::GetIO().AddKeyEvent(key, true);
    h.frames(1);
    ImGui::GetIO().AddKeyEvent(key, false);
    h.frames(2);
  }

  std::map<std::string, std::string> kept;
  Headless h;
};

// The laboratory as it opens by default: the opening scene from its start, with adaptive sub-steps.
void expect_laboratory(const Headless& h) {
  EXPECT_FALSE(h.app->introduction.open());
  EXPECT_EQ(h.app->session.scene().name, "swinging_box");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  EXPECT_EQ(h.app->session.speed(), 1.0);
  EXPECT_TRUE(h.app->session.playing());
  EXPECT_LT(h.app->session.state().time, 0.2);
  EXPECT_FALSE(h.app->compare.open());
}

TEST(Introduction, OneChainTearsInSlowMotionAndTheOtherHolds) {
  Visit visit;
  ASSERT_TRUE(visit.open());
  visit.h.frames(60);
  EXPECT_NEAR(visit.h.app->session.state().time, 0.25, 0.05) << "it is not slow";
  EXPECT_EQ(visit.torn().report.n_substeps, 1);
  visit.h.frames(60);
  EXPECT_NEAR(visit.torn().verdict->failed_at(), 0.35, 0.005);
  IntroductionWords words = introduction_words(*visit.h.app);
  EXPECT_TRUE(words.torn.note.starts_with("Torn at 0.35 s")) << words.torn.note;
  EXPECT_NE(words.held.title.find("now 1"), std::string::npos) << words.held.title;
  visit.h.frames(260);
  EXPECT_EQ(visit.h.app->session.speed(), 1.0) << "slow only while it tears";
  EXPECT_GT(visit.h.app->session.state().time, 1.0);
  EXPECT_TRUE(visit.h.app->session.verdict().holds());
}

TEST(Introduction, BothStartAgainTogetherUnlessMotionIsReduced) {
  Visit visit;
  const auto start = visit.h.app->session.hash();
  bool again = false;
  for (int i = 0; i < 600 && !again; ++i) {
    const double before = visit.h.app->session.state().time;
    visit.h.frames(1);
    again = visit.h.app->session.state().time < before;
    EXPECT_EQ(visit.torn().simulator->state().frame, visit.h.app->session.state().frame);
  }
  EXPECT_TRUE(again);
  EXPECT_TRUE(visit.torn().verdict->holds()) << "it was not rewound";
  EXPECT_NE(start, 0U);

  visit.h.app->desk.reduced_motion = true;
  visit.h.frames(600);
  EXPECT_FALSE(visit.h.app->session.playing());
  EXPECT_GT(visit.h.app->session.state().time, 3.9);
  EXPECT_TRUE(visit.open());
}

TEST(Introduction, TryItOpensTheLaboratoryAndIsRemembered) {
  Visit visit;
  visit.h.frames(40);
  visit.h.press("Try it");
  expect_laboratory(visit.h);
  visit.h.app->introduction.offer(*visit.h.app);
  EXPECT_FALSE(visit.open()) << "it was left once";
}

TEST(Introduction, EnterEscapeAndATapLeaveIt) {
  for (const ImGuiKey key : {ImGuiKey_Enter, ImGuiKey_Escape}) {
    Visit visit;
    visit.press(key);
    expect_laboratory(visit.h);
  }
  Visit visit(390.0F, 844.0F);
  visit.h.click(195.0F, 300.0F);
  expect_laboratory(visit.h);
}

TEST(Introduction, TourGoesToItsFirstStep) {
  Visit visit;
  visit.h.press("Tour");
  visit.h.frames(2);
  EXPECT_FALSE(visit.open());
  EXPECT_EQ(visit.h.app->desk.tour, 0);
  EXPECT_EQ(visit.h.app->session.settings().mode, Mode::kNone);
}

TEST(Introduction, ALinkASceneOrASettingSkipsIt) {
  {
    Visit visit;
    visit.h.app->open_link("scene=bridge&mode=none");
    visit.h.frames(2);
    EXPECT_FALSE(visit.open());
    EXPECT_EQ(visit.h.app->session.scene().name, "bridge");
    EXPECT_EQ(visit.h.app->session.speed(), 1.0);
  }
  {
    Visit visit;
    EXPECT_TRUE(visit.h.app->open("bridge"));
    visit.h.frames(2);
    EXPECT_FALSE(visit.open());
    EXPECT_EQ(visit.h.app->session.scene().name, "bridge");
    EXPECT_FALSE(visit.h.app->compare.open());
  }
  Visit visit;
  EXPECT_EQ(visit.h.app->set("mode", "damping"), "");
  EXPECT_FALSE(visit.open());
  EXPECT_EQ(visit.h.app->session.settings().mode, Mode::kDamping);
}

TEST(Introduction, KeysOfTheLaboratoryAreInactive) {
  Visit visit;
  const auto before = visit.h.app->session.state().frame;
  visit.h.type("rb13.?h");
  EXPECT_TRUE(visit.open());
  EXPECT_TRUE(visit.h.app->session.playing());
  EXPECT_GE(visit.h.app->session.state().frame, before);
  EXPECT_EQ(visit.h.app->session.settings().mode, Mode::kAdaptive);
  EXPECT_FALSE(visit.h.app->desk.help);
  visit.h.type("t");
  EXPECT_FALSE(visit.h.app->desk.dark);
}

TEST(Introduction, IsPausedByMouseAndBySpace) {
  for (const auto& [width, height] :
       {std::pair{1280.0F, 720.0F}, std::pair{390.0F, 844.0F}, std::pair{844.0F, 390.0F}}) {
    Visit visit(width, height);
    visit.h.press("pause");
    EXPECT_TRUE(visit.open());
    EXPECT_FALSE(visit.h.app->session.playing());
    const auto frame = visit.h.app->session.state().frame;
    visit.h.frames(20);
    EXPECT_EQ(visit.h.app->session.state().frame, frame);
    visit.h.press("play");
    EXPECT_TRUE(visit.h.app->session.playing());
    visit.h.type(" ");
    EXPECT_FALSE(visit.h.app->session.playing());
    EXPECT_TRUE(visit.open());
  }
}

TEST(Introduction, WithReducedMotionItIsAStillOfTheTornChain) {
  Headless h;
  h.app->desk.reduced_motion = true;
  h.app->session.play();
  h.app->introduction.start(*h.app);
  h.frames(30);
  EXPECT_TRUE(h.app->introduction.open());
  EXPECT_FALSE(h.app->session.playing());
  EXPECT_NEAR(h.app->session.state().time, 1.0, 1e-9);
  EXPECT_TRUE(h.app->session.verdict().holds());
  EXPECT_FALSE(h.app->compare.runs().front().verdict->holds());
  EXPECT_EQ(h.app->compare.runs().front().simulator->state().frame, 60);
}

TEST(Introduction, TheAddressStaysPlainUntilItIsLeft) {
  Visit visit;
  std::string link;
  visit.h.app->host.link_changed = [&](const std::string& fragment) { link = fragment; };
  visit.h.frames(4);
  EXPECT_EQ(link, "");
  visit.h.press("Try it");
  EXPECT_EQ(link.substr(0, 18), "scene=swinging_box");
  EXPECT_EQ(link.find("compare"), std::string::npos);
}

TEST(Introduction, AboutLeadsBackToItAndTheRunStartsAgain) {
  Headless h;
  h.app->open("bridge");
  h.app->set("mode", "damping");
  h.app->session.play();
  h.type("?");
  h.press("First screen");
  h.frames(3);
  EXPECT_TRUE(h.app->introduction.open());
  EXPECT_FALSE(h.app->desk.help);
  EXPECT_EQ(h.app->session.scene().name, "swinging_box");
  h.press("Try it");
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);
  EXPECT_TRUE(h.app->session.playing());
}

TEST(Introduction, WithoutStorageItIsNotShown) {
  Headless h;
  h.app->introduction.offer(*h.app);
  EXPECT_FALSE(h.app->introduction.open());
}

TEST(Introduction, BothPicturesAndButtonsAreOnEveryDisplay) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F},
                                      {1920.0F, 1080.0F},
                                      {390.0F, 844.0F},
                                      {844.0F, 390.0F},
                                      {320.0F, 568.0F}}) {
    Visit visit(width, height);
    ASSERT_EQ(visit.h.app->panes.size(), 2U);
    for (const ViewRect& pane : visit.h.app->panes) {
      EXPECT_GE(pane.x, 0.0F);
      EXPECT_LE(pane.x + pane.width, width);
      EXPECT_GT(pane.width, 150.0F);
      EXPECT_GT(pane.height, 110.0F) << width << "x" << height;
    }
    for (const char* label : {"Try it", "Tour"}) {
      const ui::Handle* button = find_handle(label);
      ASSERT_NE(button, nullptr) << label;
      EXPECT_GE(button->max.y - button->min.y, 36.0F);
      EXPECT_LE(button->max.x, width);
      EXPECT_LE(button->max.y, height);
      for (const ViewRect& pane : visit.h.app->panes) {
        EXPECT_GE(button->min.y, pane.y + pane.height) << label;
      }
    }
    EXPECT_EQ(ui::handles().size(), 3U);
  }
}

}  // namespace
}  // namespace substep
