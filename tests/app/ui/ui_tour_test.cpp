#include "app/text/tour.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/text/tour_words.hpp"
#include "core/model/number_text.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// The session and the compared runs, ten seconds into a step of the tour.
class Step {
 public:
  explicit Step(int number, int frames = 600) {
    EXPECT_EQ(h.app->set("tour", std::to_string(number)), "");
    for (int i = 0; i < frames; ++i) h.app->session.step();
  }
  Session& session() { return h.app->session; }
  const Compare::Run& ghost() { return h.app->compare.runs().at(0); }
  // Share of the exchanged energy lost since the start.
  double lost(const History& history) {
    return -static_cast<double>(history[Channel::kDrift].back()) /
           *session().scene().criteria.energy_scale;
  }
  Extent substeps(const History& history) {
    return history.samples(Channel::kSubsteps).extent(0, history.size());
  }

  Headless h;
};

// A step as a user performs it: set a number, and wait for the answer from the run.
class Task {
 public:
  explicit Task(int number) { EXPECT_EQ(h.app->set("tour", std::to_string(number)), ""); }
  TourWords words() {
    return tour_words(*h.app, static_cast<std::size_t>(h.app->desk.tour), h.app->tour.loop());
  }
  /// Sets a number and lets the loop run for up to a minute until there is an answer.
  TourReply answer(const std::string& name, const std::string& value) {
    EXPECT_EQ(h.app->set(name, value), "");
    h.app->reset();
    return answer();
  }
  TourReply answer() {
    h.frames(1);
    for (int i = 0; i < 3600 && words().reply.text.empty(); ++i) h.frames(1);
    return words().reply;
  }

  Headless h;
};

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(TourMarkup, PiecesComeInOrder) {
  using Kind = TourPart::Kind;
  const std::vector<TourPart> wanted{{Kind::kText, "With ", ""},
                                     {Kind::kNumber, "", "n"},
                                     {Kind::kText, " sub-steps (of ", ""},
                                     {Kind::kPlace, "the plot of N", "substeps"},
                                     {Kind::kText, ").", ""}};
  EXPECT_EQ(tour_parts("With {n} sub-steps (of [the plot of N](substeps))."), wanted);
  EXPECT_TRUE(tour_parts("").empty());
}

TEST(TourMarkup, UnclosedMarkupIsText) {
  for (const char* text : {"a { b", "[a](b", "[a] (b)", "a [b", "}"}) {
    const std::vector<TourPart> parts = tour_parts(text);
    ASSERT_EQ(parts.size(), 1U) << text;
    EXPECT_EQ(parts[0].text, text);
    EXPECT_EQ(parts[0].kind, TourPart::Kind::kText);
  }
}

TEST(TourMarkup, NumbersAndPlacesOfTheStepsExist) {
  Headless h;
  for (const TourStep& step : tour_steps()) {
    for (const char* sentence : {step.text, step.watch, step.task}) {
      for (const TourPart& part : tour_parts(sentence)) {
        EXPECT_EQ(part.text.find_first_of("{}[]"), std::string::npos) << sentence;
        if (part.kind == TourPart::Kind::kNumber) {
          const TourNumber number = tour_number(*h.app, part.name);
          EXPECT_EQ(number.name, part.name);
          EXPECT_TRUE(std::is_sorted(number.stops.begin(), number.stops.end()));
          for (const double stop : number.stops) {
            EXPECT_EQ(h.app->set(part.name, number_text(stop)), "") << part.name;
            EXPECT_EQ(tour_number(*h.app, part.name).value, stop);
          }
        }
        if (part.kind != TourPart::Kind::kPlace) continue;
        const auto places = tour_places();
        EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const TourPlace& place) {
          return place.name == part.name;
        })) << part.name;
      }
    }
  }
}

TEST(TourMarkup, SentencesAreReadWithTheNumbersOfTheRun) {
  Task task(1);
  EXPECT_TRUE(contains(tour_sentence(task.words().text, task.words().numbers), "1,000 kg"));
  task.h.app->set("load", "0.1");
  EXPECT_TRUE(contains(tour_sentence(task.words().text, task.words().numbers), "of 100 kg hangs"));
}

TEST(Tour, EveryPlaceIsInTheWindowThatItsStepOpens) {
  Headless h(1280.0F, 720.0F);
  for (std::size_t i = 0; i < tour_steps().size(); ++i) {
    ASSERT_EQ(h.app->set("tour", std::to_string(i + 1)), "");
    h.frames(90);
    for (const TourPart& part : tour_parts(tour_steps()[i].watch)) {
      if (part.kind != TourPart::Kind::kPlace) continue;
      for (const TourPlace& place : tour_places()) {
        if (place.name != part.name) continue;
        if (place.name == "accuracy") {  // its own panel, which the step only leads to
          h.app->set("panel", "accuracy");
          h.frames(3);
        }
        const auto& all = ui::handles();
        EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                [&](const ui::Handle& handle) {
                                  return handle.group == place.group && handle.label == place.label;
                                }))
            << place.name << " in step " << i + 1;
      }
    }
  }
}

TEST(Tour, NoneTearsAtTheStatedTime) {
  Step step(1, 60);
  EXPECT_FALSE(step.session().verdict().holds());
  EXPECT_NEAR(step.session().verdict().failed_at(), 0.35, 0.005);
  int links = 0;
  for (const Body& body : step.session().scene().bodies)
    links += body.name.starts_with("link") && body.mass == 1.0 ? 1 : 0;
  EXPECT_EQ(links, 25);
}

TEST(Tour, ALighterBoxIsAnswered) {
  Task task(1);
  TourReply reply = task.answer();
  EXPECT_EQ(reply.text, "With 1,000 kg the chain tears at 0.35 s.");
  EXPECT_FALSE(reply.done);
  reply = task.answer("load", "0.01");
  EXPECT_TRUE(reply.done);
  EXPECT_TRUE(reply.text.starts_with("With 10 kg the run gains energy and fails at 1."))
      << reply.text;
}

TEST(Tour, SevenHoldAndSixTear) {
  Task task(2);
  TourReply reply = task.answer();
  EXPECT_EQ(reply.text, "With 7 sub-steps it holds for 4 s.");
  EXPECT_FALSE(reply.done);
  reply = task.answer("n", "6");
  EXPECT_TRUE(reply.text.starts_with("With 6 sub-steps the ")) << reply.text;
  EXPECT_TRUE(reply.done);
  reply = task.answer("n", "8");
  EXPECT_EQ(reply.text, "With 8 sub-steps it holds for 4 s.");
  EXPECT_FALSE(reply.done);
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

TEST(Tour, LosingLessThanATenthIsAnswered) {
  Task task(3);
  EXPECT_FALSE(task.answer().done);
  EXPECT_FALSE(task.answer("n_cap", "2").done);
  const TourReply reply = task.answer("n_cap", "3");
  EXPECT_TRUE(reply.done) << reply.text;
}

TEST(Tour, TheRangeOfNIsAnswered) {
  Task task(4);
  EXPECT_EQ(task.answer().text, "After 10 s: N from 10 to 20, 0.15 % of its energy lost.");
}

TEST(Tour, AQuarterOfAlphaIsTwiceTheSubstepsAndHalfTheLoss) {
  Step step(5, 0);
  EXPECT_EQ(step.h.app->set("alpha", "0.025"), "");
  step.h.app->reset();
  for (int i = 0; i < 600; ++i) step.session().step();
  const Extent n = step.substeps(step.ghost().history);
  const Extent more = step.substeps(step.session().history());
  EXPECT_EQ(2.0F * n.high, more.high);
  EXPECT_EQ(2.0F * n.low, more.low);
  EXPECT_NEAR(step.lost(step.session().history()) / step.lost(step.ghost().history), 0.5, 0.05);
  Task task(5);
  EXPECT_FALSE(task.answer().done);
  const TourReply reply = task.answer("alpha", "0.025");
  EXPECT_TRUE(reply.done) << reply.text;
  EXPECT_TRUE(contains(reply.text, " 2.0 times the ghost's")) << reply.text;
}

TEST(Tour, AtFourTimesTheLoadSevenTearAndAdaptiveHoldsWithTwiceTheSubsteps) {
  Task task(6);
  TourReply reply = task.answer();
  EXPECT_FALSE(reply.done) << reply.text;
  EXPECT_TRUE(contains(reply.text, "N is up to 20 ")) << reply.text;
  reply = task.answer("load", "4");
  EXPECT_TRUE(reply.done) << reply.text;
  EXPECT_TRUE(contains(reply.text, "With 4,000 kg N is up to 39 ") ||
              contains(reply.text, "With 4,000 kg N is up to 40 "))
      << reply.text;
  EXPECT_TRUE(contains(reply.text, "With 7 constant sub-steps the ")) << reply.text;
  EXPECT_TRUE(task.h.app->compare.open()) << "the ghost is gone";
}

TEST(Tour, NFollowsTheLoadsOfTheConvoyAndSevenTearItsBridge) {
  Task task(7);
  TourReply reply = task.answer();
  EXPECT_FALSE(reply.done) << reply.text;
  EXPECT_TRUE(contains(reply.text, "N from 2 to ")) << reply.text;
  EXPECT_TRUE(contains(reply.text, "With 13 constant sub-steps it takes 6,552, 1.6 times as many."))
      << reply.text;
  reply = task.answer("n", "7");
  EXPECT_TRUE(reply.done) << reply.text;
  EXPECT_TRUE(contains(reply.text, "With 7 constant sub-steps the bridge tears at ")) << reply.text;
}

TEST(Tour, LeapfrogKeepsTheEnergyToAMillionthAtTheSameCost) {
  Step step(8);
  EXPECT_LT(std::abs(step.lost(step.session().history())), 1e-6);
  EXPECT_GT(step.lost(step.ghost().history), 1e-3);
  EXPECT_NEAR(static_cast<double>(step.ghost().cost.substeps) / 9475.0, 1.0, 0.01);
  Task task(8);
  EXPECT_FALSE(task.answer().done);
  const TourReply reply = task.answer("alpha", "0.4");
  EXPECT_TRUE(reply.done) << reply.text;
}

TEST(Tour, RepeatsTheFailureInSlowMotion) {
  Task task(1);
  task.h.frames(60);
  EXPECT_NEAR(task.h.app->session.state().time, 0.25, 0.05) << "it is not slow";
  int starts = 0;
  for (int i = 0; i < 1200; ++i) {
    const double before = task.h.app->session.state().time;
    task.h.frames(1);
    if (task.h.app->session.state().time < before) ++starts;
    EXPECT_LT(before, 1.4) << "the pieces are far away by then";
  }
  EXPECT_GE(starts, 2);
  EXPECT_TRUE(task.h.app->session.playing());
}

TEST(Tour, StopsAtTheEndWhereMotionIsReduced) {
  Task task(1);
  task.h.app->desk.reduced_motion = true;
  task.h.frames(900);
  EXPECT_FALSE(task.h.app->session.playing());
  EXPECT_FALSE(task.h.app->session.verdict().holds());
  task.h.app->session.play();  // once more
  task.h.frames(2);
  EXPECT_TRUE(task.h.app->session.playing());
  EXPECT_LT(task.h.app->session.state().time, 0.1);
}

TEST(Tour, ANumberThatIsChangedAfterAFailureStartsTheRunAgain) {
  Task task(1);
  task.h.frames(150);
  ASSERT_FALSE(task.h.app->session.verdict().holds());
  ASSERT_EQ(task.h.app->set("mode", "adaptive"), "");
  task.h.frames(2);
  EXPECT_TRUE(task.h.app->session.verdict().holds());
  EXPECT_LT(task.h.app->session.state().time, 0.1);
}

TEST(Tour, RestoresThePreviousRun) {
  Headless h;
  ASSERT_TRUE(h.app->open("bridge"));
  h.app->set("mode", "damping");
  h.app->set("compare", "mode:none");
  h.app->set("level", "lab");
  h.app->set("panel", "why");
  h.app->desk.split = true;
  h.app->session.set_speed(0.5);
  h.app->session.play();
  h.frames(4);
  for (std::size_t i = 1; i <= tour_steps().size(); ++i) {
    h.app->desk.follow = "tour=" + std::to_string(i);
    h.frames(3);
  }
  EXPECT_EQ(h.app->session.scene().name, scene_of(tour_steps().back()));
  EXPECT_FALSE(h.app->desk.split);
  h.press("Done");
  h.frames(2);
  EXPECT_LT(h.app->desk.tour, 0);
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);
  EXPECT_TRUE(h.app->session.playing());
  EXPECT_EQ(h.app->session.speed(), 0.5);
  ASSERT_EQ(h.app->compare.runs().size(), 1U);
  EXPECT_EQ(h.app->compare.runs()[0].overrides, (Overrides{{"mode", "none"}}));
  EXPECT_TRUE(h.app->desk.split);
  EXPECT_EQ(h.app->desk.tab, Tab::kWhy);
  EXPECT_EQ(h.app->desk.level, DeskLevel::kLab);
  EXPECT_TRUE(h.app->hold_at_failure);
  for (const Plot plot : {Plot::kSubsteps, Plot::kEnergy, Plot::kDrift, Plot::kError}) {
    EXPECT_TRUE(h.app->desk.plot(plot).shown);
  }
}

TEST(Tour, RestoresEventsAndTheEndOfAnExperiment) {
  Headless h;
  h.app->session.pause();
  ASSERT_EQ(h.app->set("n", "9"), "");
  for (int i = 0; i < 5; ++i) h.app->session.step();
  Ball ball;
  ball.position = {5.0, 1.0, 0.5};
  ball.velocity = {-8.0, 0.0, 0.0};
  h.app->session.throw_ball(ball);
  for (int i = 0; i < 5; ++i) h.app->session.step();
  ASSERT_EQ(h.app->set("seconds", "2"), "");
  const std::string link = h.app->link();
  ASSERT_NE(link.find("events="), std::string::npos);
  ASSERT_EQ(h.app->set("tour", "2"), "");
  h.frames(3);
  ASSERT_EQ(h.app->set("tour", "off"), "");
  EXPECT_EQ(h.app->link(), link);
  EXPECT_EQ(h.app->pause_at, 2.0);
  EXPECT_FALSE(h.app->session.playing());
}

TEST(Tour, ALinkToItsSceneEndsIt) {
  Task task(3);
  task.h.frames(3);
  task.h.app->open_link("scene=swinging_box&mode=const&n=12");
  task.h.frames(3);
  EXPECT_LT(task.h.app->desk.tour, 0);
  EXPECT_FALSE(task.h.app->tour.loop().open());
  EXPECT_TRUE(task.h.app->hold_at_failure);
  EXPECT_EQ(task.h.app->session.settings().n, 12);
}

TEST(Tour, AnotherSceneEndsIt) {
  Task task(3);
  task.h.frames(3);
  ASSERT_TRUE(task.h.app->open("bridge"));
  task.h.frames(3);
  EXPECT_LT(task.h.app->desk.tour, 0);
  EXPECT_EQ(task.h.app->session.scene().name, "bridge");
  EXPECT_FALSE(task.h.app->compare.open());
  EXPECT_EQ(task.h.app->session.speed(), 1.0);
}

TEST(Tour, ItsArrangementIsNotStored) {
  Headless h;
  std::string kept;
  h.app->host.remember = [&](const std::string&, const std::string& value) { kept = value; };
  h.app->desk.level = DeskLevel::kExplore;
  h.frames(2);
  h.app->set("tour", "8");
  h.app->set("panel", "accuracy");
  h.frames(3);
  EXPECT_TRUE(contains(kept, "level=explore")) << kept;
}

TEST(Tour, ThePageShowsItsTextInsteadOfTheWindow) {
  Headless h;
  h.app->desk.tour_in_page = true;
  h.app->set("tour", "1");
  h.frames(4);
  EXPECT_EQ(find_handle("Next"), nullptr);
  EXPECT_EQ(find_handle("Tour"), nullptr);
  EXPECT_EQ(h.app->desk.tour_height, 0.0F);
  EXPECT_FALSE(h.app->desk.left.open) << "its column takes the place of the controls";
  h.app->set("tour", "off");
  h.frames(2);
  EXPECT_TRUE(h.app->desk.left.open);
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
    EXPECT_NE(h.app->set("tour", "9"), "");
    EXPECT_EQ(h.app->set("tour", "off"), "");
    EXPECT_LT(h.app->desk.tour, 0);
  }
}

}  // namespace
}  // namespace substep
