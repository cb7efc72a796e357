// Manual interactions with a run, stored in its link and repeated bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/text/event_text.hpp"
#include "app/text/letters.hpp"
#include "core/io/scene_writer.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

constexpr std::size_t kShort = 2000;  // [characters] accepted by messengers

/// Balls that differ in all digits of all numbers.
Ball odd_ball(int i) {
  const double a = std::sin(1.0 + i);
  const double b = std::cos(3.0 + i);
  return {{3.0 * a, 6.0 + b, 4.0 + a * b}, {-4.0 * a, b, -6.0 - a}, 0.1 + 0.1 * a * a, 5.0 + b};
}

void step(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.step();
}

/// Opens the link in another application and runs it to the same frame.
void expect_same_run(Headless& h, const char* what) {
  const std::string link = h.app->link();
  EXPECT_EQ(h.app->trouble.title, "") << what;
  Headless other;
  other.app->open_link(link);
  EXPECT_EQ(other.app->trouble.title, "") << what << ": " << link;
  EXPECT_EQ(other.app->link(), link) << what << ": the link is the same at the start";
  other.app->session.pause();
  step(other.app->session, static_cast<int>(h.app->session.state().frame));
  EXPECT_EQ(other.app->session.hash(), h.app->session.hash()) << what;
  EXPECT_EQ(other.app->link(), link) << what << ": the link is the same at the end";
  other.app->reset();
  step(other.app->session, static_cast<int>(h.app->session.state().frame));
  EXPECT_EQ(other.app->session.hash(), h.app->session.hash()) << what << ", after a reset";
}

TEST(Events, TwentyBallsGiveAShortLinkAndTheSameBits) {
  for (const char* name : {"swinging_box", "bridge", "wall"}) {
    Headless h;
    ASSERT_EQ(h.app->set("scene", name), "");
    h.app->session.pause();
    for (int i = 0; i < 20; ++i) {
      step(h.app->session, 1 + i % 4);
      h.app->session.throw_ball(odd_ball(i));
    }
    step(h.app->session, 20);
    const std::string link = h.app->link();
    EXPECT_LT(link.size(), kShort) << name;
    EXPECT_FALSE(is_own(h.app->link_scene())) << name;
    expect_same_run(h, name);
  }
}

TEST(Events, ABallThrownByItsKeyIsInTheLink) {
  Headless h;
  h.app->session.pause();
  step(h.app->session, 30);
  h.type("b");
  ASSERT_EQ(h.app->session.balls(), 1U);
  EXPECT_LT(h.app->link().size(), 220U) << h.app->link();
  step(h.app->session, 60);
  expect_same_run(h, "thrown by key");
}

TEST(Events, APullIsRepeated) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  step(session, 10);
  const auto body = static_cast<int>(session.scene().bodies.size()) - 1;
  session.grab(body, Vec3(0.1, 0.2, 0.3), session.state().x.back());
  for (int i = 0; i < 120; ++i) {  // the pointer moves for two seconds
    session.pull_to(Vec3(2.0 * std::sin(0.05 * i), 3.0 + 0.01 * i, 1.0 / (3.0 + i)));
    step(session, 1);
  }
  step(session, 30);  // rests
  session.let_go();
  step(session, 30);
  EXPECT_LT(h.app->link().size(), kShort);
  expect_same_run(h, "a pull");
}

TEST(Events, EffectsSettingsAndASeedAreRepeated) {
  Headless h;
  h.app->open_link("scene=bridge&load=2&seed=3&alpha=0.3");
  h.app->session.pause();
  step(h.app->session, 10);
  ASSERT_EQ(h.app->set("alpha", "0.15"), "");
  step(h.app->session, 5);
  ASSERT_EQ(h.app->set("mode", "const"), "");
  ASSERT_EQ(h.app->set("n", "9"), "");
  Effects effects = h.app->session.scene().effects;
  effects.gravity = false;
  h.app->session.set_effects(effects);
  step(h.app->session, 5);
  h.app->session.throw_ball(odd_ball(1));
  step(h.app->session, 5);
  EXPECT_NE(h.app->link().find("&alpha=0.3&"), std::string::npos) << "the initial setting";
  EXPECT_LT(h.app->link().size(), 400U);
  expect_same_run(h, "effects, settings, a seed");
}

// Without interactions a link has the current settings: users adjust them before they share.
TEST(Events, SettingsAloneAreNoEvents) {
  Headless h;
  h.app->session.pause();
  step(h.app->session, 10);
  ASSERT_EQ(h.app->set("alpha", "0.25"), "");
  step(h.app->session, 10);
  EXPECT_EQ(h.app->link().find("events="), std::string::npos);
  EXPECT_NE(h.app->link().find("alpha=0.25"), std::string::npos);
}

TEST(Events, TheLinkOfAUsersSceneHasBoth) {
  Scene scene = *shipped("pendulum");
  scene.name = "mine";
  Headless h;
  ASSERT_TRUE(h.app->open_text(write_scene(scene), "mine.json"));
  h.app->session.pause();
  step(h.app->session, 7);
  h.app->session.throw_ball(odd_ball(0));
  step(h.app->session, 20);
  ASSERT_TRUE(is_own(h.app->link_scene()));
  EXPECT_EQ(h.app->link_scene().bodies.size(), scene.bodies.size());
  Headless other;
  other.app->open_link(h.app->link().substr(h.app->link().find('&') + 1),
                       read_scene(write_scene(h.app->link_scene())));
  EXPECT_EQ(other.app->trouble.title, "");
  other.app->session.pause();
  step(other.app->session, 27);
  EXPECT_EQ(other.app->session.hash(), h.app->session.hash());
}

TEST(Events, GoingBackDropsLaterOnes) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 3; ++i) {
    step(session, 10);
    session.throw_ball(odd_ball(i));
  }
  step(session, 10);
  const std::string all = h.app->link();
  session.go_to(session.timeline().at_time(15.0 * session.scene().frame));
  const std::string first = h.app->link();
  EXPECT_LT(first.size(), all.size());
  session.go_to(session.timeline().size() - 1);
  EXPECT_EQ(h.app->link(), all) << "going back alone drops no event";
  session.go_to(15);
  session.throw_ball(odd_ball(7));
  step(session, 10);
  EXPECT_EQ(session.balls(), 2U);
  expect_same_run(h, "continued from the past");
}

TEST(Events, AScriptContinuesFromThePast) {
  Headless h;
  h.app->session.pause();
  step(h.app->session, 20);
  h.app->session.throw_ball(odd_ball(2));
  step(h.app->session, 10);
  ASSERT_EQ(h.app->set("alpha", "0.2"), "");
  step(h.app->session, 20);
  Headless other;
  other.app->open_link(h.app->link());
  Session& session = other.app->session;
  session.pause();
  step(session, 40);
  session.go_to(10);
  session.play();
  session.pause();
  ASSERT_EQ(session.state().frame, 10);
  session.grab(0, Vec3::Zero(), Vec3::Zero());  // a manual action drops the remaining events
  session.let_go();
  step(session, 40);
  EXPECT_EQ(session.balls(), 0U);
  other.app->reset();
  step(session, 50);
  EXPECT_EQ(session.hash(), h.app->session.hash()) << "a reset is the link's run again";
}

TEST(Events, NewSettingsStayAndTheScriptContinues) {
  Headless h;
  h.app->session.pause();
  step(h.app->session, 5);
  ASSERT_EQ(h.app->set("alpha", "0.2"), "");
  step(h.app->session, 15);
  h.app->session.throw_ball(odd_ball(3));
  Headless other;
  other.app->open_link(h.app->link());
  other.app->session.pause();
  ASSERT_EQ(other.app->set("alpha", "0.4"), "");
  step(other.app->session, 30);
  EXPECT_EQ(other.app->session.settings().alpha, 0.4);
  EXPECT_EQ(other.app->session.balls(), 1U);
}

TEST(Events, TooManyForALinkAreReplacedByTheEditedScene) {
  Headless h;
  Session& session = h.app->session;
  session.pause();
  session.throw_ball(odd_ball(0));
  session.grab(1, Vec3::Zero(), Vec3::Zero());
  for (int i = 0; i < 1500; ++i) {
    session.pull_to(Vec3(std::sin(0.7 * i), std::cos(1.1 * i), std::sin(1.3 * i)));
    step(session, 1);
    if (session.stopped()) break;
  }
  EXPECT_EQ(h.app->link().find("events="), std::string::npos);
  EXPECT_TRUE(is_own(h.app->link_scene())) << "the link of an edited scene";
}

TEST(Events, EverySwitchedEffectIsReadBack) {
  const auto scene = shipped("swinging_box");
  for (const EffectEntry& effect : kEffects) {
    Effects effects;
    effects.*effect.member = true;
    const RunEvent event{2, effects};
    std::string message;
    const auto read =
        read_events(events_text({&event, 1}, scene->settings), *scene, scene->settings, message);
    ASSERT_EQ(read.size(), 1U) << effect.name << ": " << message;
    EXPECT_EQ(std::get<Effects>(read[0].what), effects) << effect.name;
  }
}

TEST(Events, InvalidTextIsReported) {
  const auto scene = shipped("swinging_box");
  const Settings settings = scene->settings;
  const auto problem = [&](const std::string& text) {
    std::string message;
    const auto events = read_events(text, *scene, settings, message);
    EXPECT_EQ(events.empty(), !message.empty()) << text;
    return message;
  };
  const std::vector<RunEvent> balls{{3, odd_ball(0)}, {9, odd_ball(1)}};
  const std::string text = events_text(balls, settings);
  EXPECT_EQ(problem(text), "");
  EXPECT_NE(problem(text.substr(0, text.size() - 4)).find("truncated"), std::string::npos);
  EXPECT_NE(problem(text + "%").find("truncated"), std::string::npos);
  EXPECT_NE(problem("").find("truncated"), std::string::npos);
  EXPECT_NE(problem(std::string(kMostEventText + 1, 'A')).find("characters"), std::string::npos);
  EXPECT_NE(problem(to_letters({9, 0})).find("version"), std::string::npos);
  EXPECT_NE(problem(to_letters({1, 7})).find("kind"), std::string::npos);
  const auto one = [&](const RunEvent& event) { return events_text({&event, 1}, settings); };
  Ball heavy = odd_ball(0);
  heavy.mass = 1e13;
  EXPECT_NE(problem(one({0, heavy})).find("mass"), std::string::npos);
  heavy.mass = std::nan("");
  EXPECT_NE(problem(one({0, heavy})).find("mass"), std::string::npos);
  heavy = odd_ball(0);
  heavy.radius = 1e-200;  // without an inertia
  EXPECT_NE(problem(one({0, heavy})).find("ball"), std::string::npos);
  EXPECT_NE(problem(one({0, Pull{99, Vec3::Zero(), Vec3::Zero()}})).find("does not move"),
            std::string::npos);
  EXPECT_NE(
      problem(one({0, Pull{1, Vec3::Constant(1e9), Vec3::Zero()}})).find("outside all bodies"),
      std::string::npos);
  EXPECT_NE(problem(one({200'000'000, LetGo{}})).find("too late"), std::string::npos);
  Settings wild = settings;
  wild.alpha = 7.0;
  EXPECT_NE(problem(one({0, wild})).find("alpha must be"), std::string::npos);
}

TEST(Events, ALinkWithBadEventsRunsTheRest) {
  Headless h;
  h.app->open_link("events=AAAA&scene=bridge&alpha=0.3");
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(h.app->session.settings().alpha, 0.3);
  ASSERT_EQ(h.app->trouble.problems.size(), 1U);
  EXPECT_EQ(h.app->trouble.problems.front().pointer, "events");
}

// The maximum number of events before one frame is applied at once; the run continues.
TEST(Events, TheMaximumAtOnceIsAccepted) {
  const auto scene = shipped("wall");
  std::vector<RunEvent> events;
  for (int i = 0; fits_link(events, *scene); ++i) {
    Effects effects = scene->effects;
    effects.friction = i % 2 == 0;
    events.push_back({0, effects});
  }
  Headless h;
  h.app->open_link("scene=wall&events=" + events_text(events, scene->settings));
  ASSERT_EQ(h.app->trouble.problems.size(), 1U) << "one too many";
  events.pop_back();
  h.app->trouble = {};
  h.app->open_link("scene=wall&events=" + events_text(events, scene->settings));
  EXPECT_EQ(h.app->trouble.title, "");
  h.app->session.pause();
  step(h.app->session, 2);
  EXPECT_EQ(h.app->session.state().frame, 2);
}

// Each ball copies the scene, so a scene of many bodies allows only a few.
TEST(Events, AreLimitedInALargeScene) {
  Scene large = *shipped("pendulum");
  large.bodies.resize(2000, large.bodies.back());
  std::vector<RunEvent> events(40, RunEvent{0, odd_ball(0)});
  EXPECT_FALSE(fits_link(events, large));
  events.resize(2);
  EXPECT_TRUE(fits_link(events, large));
}

}  // namespace
}  // namespace substep
