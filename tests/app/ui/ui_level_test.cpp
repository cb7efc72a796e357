// Explore and Lab: what each shows, which of them opens, and every control of Explore.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "app/shell/arrangement.hpp"
#include "core/model/methods.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// Controls that can be pressed; a control marked twice counts once, and plots do not count.
std::size_t controls_shown() {
  std::set<std::tuple<float, float, float, float>> places;
  for (const ui::Handle& h : ui::handles()) {
    if (h.group == "plot" || h.group == "why") continue;
    places.insert({h.min.x, h.min.y, h.max.x, h.max.y});
  }
  return places.size();
}

void explore(Headless& h) {
  ASSERT_EQ(h.app->set("level", "explore"), "");
  h.frames(3);
}

TEST(Explore, HasFewerThanTwentyControlsOnEveryScene) {
  for (const auto& [width, height] :
       {std::pair{1280.0F, 720.0F}, {1920.0F, 1080.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    h.app->desk.tour_hint = true;  // a first visit has one more
    explore(h);
    for (const auto& scene : h.app->library.scenes()) {
      h.app->run(scene);
      for (const char* mode : {"const", "adaptive", "capped"}) {
        h.app->set("mode", mode);
        h.frames(3);
        EXPECT_LT(controls_shown(), 20U) << scene->name << " " << mode << " at " << width;
      }
    }
    h.app->set("compare", "mode:none");
    h.frames(3);
    EXPECT_LT(controls_shown(), 20U) << "compared, at " << width;
    EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore);
  }
}

TEST(Explore, TheSwitchAtTheTopLeadsToTheLabAndBack) {
  Headless h;
  EXPECT_EQ(find_handle("Throw a ball"), nullptr);
  h.press("Explore");
  EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore);
  EXPECT_NE(find_handle("Throw a ball"), nullptr);
  EXPECT_EQ(find_handle("More"), nullptr);
  EXPECT_EQ(find_handle("Accuracy"), nullptr);
  const ui::Handle* lab = find_handle("Lab");
  ASSERT_NE(lab, nullptr);
  EXPECT_LT(lab->max.y, 60.0F) << "it is not at the top";
  h.press("Lab");
  EXPECT_NE(find_handle("More"), nullptr);
  EXPECT_NE(find_handle("Accuracy"), nullptr);
}

TEST(Explore, ModeAndSolverAreChosenFromMenus) {
  Headless h;
  explore(h);
  for (const ModeEntry& entry : kModes) {
    h.press("Stabilisation");
    h.press(entry.name);
    EXPECT_EQ(h.app->session.settings().mode, entry.value);
  }
  for (const SolverEntry& entry : kSolvers) {
    h.press("Solver");
    h.press(entry.title);
    EXPECT_EQ(h.app->session.settings().solver, entry.value);
  }
}

TEST(Explore, AlphaNAndTheCapAreSliders) {
  Headless h;
  explore(h);
  h.press("Alpha  α");
  EXPECT_NE(h.app->session.settings().alpha, 0.1);
  h.app->set("mode", "const");
  h.frames(2);
  const int n = h.app->session.settings().n;
  h.press("N");
  EXPECT_NE(h.app->session.settings().n, n);
  h.app->set("mode", "capped");
  h.frames(2);
  const int cap = h.app->session.settings().n_cap;
  h.press("N cap");
  EXPECT_NE(h.app->session.settings().n_cap, cap);
}

TEST(Explore, TheLoadIsARoundFactorAndKeepsTheComparison) {
  Headless h;
  explore(h);
  h.app->set("compare", "mode:none");
  h.app->session.play();
  h.frames(20);
  h.press("Factor  ×");
  EXPECT_NE(h.app->load, 1.0);
  const double heaviest = h.app->load * 1000.0;
  bool found = false;
  for (const Body& body : h.app->session.scene().bodies) {
    found = found || std::abs(body.mass - heaviest) < 1e-6 * heaviest;
  }
  EXPECT_TRUE(found) << heaviest;
  EXPECT_TRUE(h.app->compare.open());
  EXPECT_TRUE(h.app->session.playing());
  EXPECT_EQ(h.app->compare.runs()[0].overrides, (Overrides{{"mode", "none"}}));
}

TEST(Explore, AComparisonBeginsAtTheStartAndEnds) {
  Headless h;
  explore(h);
  h.app->session.play();
  h.frames(30);
  h.press("add");
  h.press("without sub-steps");
  ASSERT_TRUE(h.app->compare.open());
  EXPECT_LT(h.app->session.state().time, 0.1) << "both from the start";
  EXPECT_FALSE(h.app->desk.split);
  h.press("Side by side");
  EXPECT_TRUE(h.app->desk.split);
  h.frames(2);
  EXPECT_EQ(h.app->panes.size(), 2U);
  h.press("End the comparison");
  EXPECT_FALSE(h.app->compare.open());
}

TEST(Explore, ABallIsThrown) {
  Headless h;
  h.app->open("wall");
  explore(h);
  const std::size_t before = h.app->session.scene().bodies.size();
  h.press("Throw a ball");
  EXPECT_EQ(h.app->session.scene().bodies.size(), before + 1);
}

TEST(Explore, ShowsWhatSetsNOnlyInItsPanel) {
  Headless h;
  explore(h);
  h.app->session.step();
  h.frames(2);
  EXPECT_EQ(find_handle("Why N"), nullptr);
  h.app->set("panel", "why");
  h.frames(2);
  ASSERT_NE(find_handle("Why N"), nullptr);
  EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore);
  h.press("Plots");
  EXPECT_EQ(find_handle("Why N"), nullptr);
}

TEST(Level, IsInTheLinkOnlyIfItIsExplore) {
  Headless h;
  EXPECT_EQ(h.app->link().find("level"), std::string::npos);
  explore(h);
  const std::string link = h.app->link();
  EXPECT_TRUE(link.ends_with("&level=explore")) << link;
  h.press("Lab");
  h.app->open_link(link);
  EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore);
  EXPECT_TRUE(h.app->trouble.title.empty());
  EXPECT_NE(h.app->set("level", "expert"), "");
}

TEST(Level, ALinkWithSettingsOfTheLabOpensIt) {
  Headless h;
  for (const char* link :
       {"scene=bridge&integrator=leapfrog", "scene=bridge&sleep=true", "scene=bridge&seed=3",
        "scene=bridge&panel=accuracy", "scene=bridge&panel=compare", "scene=bridge&more=on",
        "scene=swinging_box&preset=recommended"}) {
    explore(h);
    h.app->open_link(link);
    EXPECT_EQ(h.app->desk.level, DeskLevel::kLab) << link;
    h.app->set("more", "off");
  }
  for (const char* link :
       {"scene=bridge", "scene=bridge&mode=const&n=12&solver=pgs", "scene=swinging_box&load=2",
        "scene=bridge&compare=mode:none", "level=explore&scene=bridge&integrator=leapfrog"}) {
    explore(h);
    h.app->open_link(link);
    EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore) << link;
  }
}

TEST(Level, AFirstVisitExploresAndTheChoiceIsRemembered) {
  std::map<std::string, std::string> kept;
  const auto visit = [&](Headless& h) {
    h.app->host.remember = [&](const std::string& k, const std::string& v) { kept[k] = v; };
    h.app->host.recall = [&](const std::string& k) { return kept[k]; };
    recall_arrangement(*h.app);
    h.frames(2);
  };
  {
    Headless h;
    visit(h);
    EXPECT_EQ(h.app->desk.level, DeskLevel::kExplore);
    h.press("Lab");
  }
  Headless h;
  visit(h);
  EXPECT_EQ(h.app->desk.level, DeskLevel::kLab);
}

TEST(Level, EffectsAreSwitchedByNameInTheLab) {
  Headless h;
  h.app->open("bridge");
  h.frames(3);
  for (const char* effect : {"gravity", "joints", "contact", "friction"}) {
    ASSERT_NE(find_handle(effect), nullptr) << effect;
  }
  h.press("friction");
  EXPECT_FALSE(h.app->session.scene().effects.friction);
}

}  // namespace
}  // namespace substep
