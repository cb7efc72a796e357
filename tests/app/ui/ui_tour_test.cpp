#include "app/text/tour.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cmath>
#include <string>

#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// The session and what runs beside it, ten seconds into a step of the tour.
class Step {
 public:
  explicit Step(int number, int frames = 600) {
    EXPECT_EQ(h.app->set("tour", std::to_string(number)), "");
    for (int i = 0; i < frames; ++i) h.app->session.step();
  }
  const Session& session() { return h.app->session; }
  const Compare::Run& ghost() { return h.app->compare.runs().at(0); }
  // Share of the exchanged energy that is gone since the start.
  double lost(const History& history) {
    return -static_cast<double>(history[Channel::kDrift].back()) /
           *session().scene().criteria.energy_scale;
  }
  Extent substeps(const History& history) {
    return history.samples(Channel::kSubsteps).extent(0, history.size());
  }

 private:
  Headless h;
};

TEST(Tour, NoneTearsWhenItSays) {
  Step step(1, 60);
  EXPECT_FALSE(step.session().verdict().holds());
  EXPECT_NEAR(step.session().verdict().failed_at(), 0.35, 0.005);
  int links = 0;
  for (const Body& body : step.session().scene().bodies)
    links += body.name.starts_with("link") && body.mass == 1.0 ? 1 : 0;
  EXPECT_EQ(links, 25);
}

TEST(Tour, SevenHoldAndSixTear) {
  Step step(2);
  EXPECT_TRUE(step.session().verdict().holds());
  EXPECT_EQ(step.session().settings().n, 7);
  EXPECT_FALSE(step.ghost().verdict->holds());
  EXPECT_GT(step.ghost().verdict->failed_at(), 1.0);  // when, is a matter of rounding
  EXPECT_LT(step.ghost().verdict->failed_at(), 7.0);
}

TEST(Tour, DampingTakesAFifthOfTheEnergy) {
  Step step(3);
  EXPECT_TRUE(step.session().verdict().holds());
  EXPECT_EQ(step.substeps(step.session().history()).high, 1.0F);
  EXPECT_NEAR(step.lost(step.session().history()), 0.2, 0.02);
  EXPECT_LT(step.lost(step.ghost().history), 0.002);
}

TEST(Tour, AdaptiveTakesTenToTwenty) {
  Step step(4);
  EXPECT_TRUE(step.session().verdict().holds());
  const Extent n = step.substeps(step.session().history());
  EXPECT_EQ(n.low, 10.0F);
  EXPECT_EQ(n.high, 20.0F);
  EXPECT_NEAR(step.lost(step.session().history()), 0.0015, 5e-5);
}

TEST(Tour, AQuarterOfAlphaIsTwiceTheSubstepsAndHalfTheLoss) {
  Step step(5);
  const Extent n = step.substeps(step.session().history());
  const Extent more = step.substeps(step.ghost().history);
  EXPECT_EQ(2.0F * n.high, more.high);
  EXPECT_EQ(2.0F * n.low, more.low);
  EXPECT_NEAR(step.lost(step.ghost().history) / step.lost(step.session().history()), 0.5, 0.05);
}

TEST(Tour, LeapfrogKeepsTheEnergyToAMillionthAtTheSameCost) {
  Step step(6);
  EXPECT_LT(std::abs(step.lost(step.session().history())), 1e-6);
  EXPECT_GT(step.lost(step.ghost().history), 1e-3);
  EXPECT_NEAR(static_cast<double>(step.ghost().cost.substeps) / 9475.0, 1.0, 0.01);
}

TEST(Tour, ItsGhostsGoWithIt) {
  Headless h;
  ASSERT_EQ(h.app->set("tour", std::to_string(tour_steps().size())), "");
  h.frames(4);
  ASSERT_TRUE(h.app->compare.open());
  h.press("Done");
  h.frames(2);
  EXPECT_LT(h.app->desk.tour, 0);
  EXPECT_FALSE(h.app->compare.open());
  EXPECT_TRUE(h.app->session.playing()) << "the run continues";
}

TEST(Tour, EveryStepFitsIntoThePictureAndEnds) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    for (std::size_t i = 1; i <= tour_steps().size(); ++i) {
      ASSERT_EQ(h.app->set("tour", std::to_string(i)), "");
      EXPECT_TRUE(h.app->trouble.title.empty()) << tour_steps()[i - 1].link;
      h.frames(4);
      const ImGuiWindow* card = ImGui::FindWindowByName("##tour");
      ASSERT_NE(card, nullptr);
      const ViewRect& v = h.app->view_rect;
      EXPECT_EQ(card->ScrollMax.y, 0.0F) << i << " at " << width;
      EXPECT_GE(card->Rect().Min.x, v.x);
      EXPECT_LE(card->Rect().Max.x, v.x + v.width);
      EXPECT_GE(card->Rect().Min.y, v.y + v.height - 1.0F);  // the picture makes room
      EXPECT_GT(v.height, 120.0F);
    }
    EXPECT_NE(h.app->set("tour", "7"), "");
    EXPECT_EQ(h.app->set("tour", "off"), "");
    EXPECT_LT(h.app->desk.tour, 0);
  }
}

}  // namespace
}  // namespace substep
