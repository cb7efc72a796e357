#include <gtest/gtest.h>

#include "app/text/link.hpp"
#include "core/io/experiment.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/experiment_run.hpp"
#include "core/model/effects.hpp"
#include "core/model/scene_builder.hpp"
#include "tests/app/ui/ui_fixture.hpp"
#include "tests/unit/unusual_settings.hpp"

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

TEST(Link, RingsJointsByTheirNames) {
  Headless h;
  ASSERT_EQ(h.app->set("scene", "swinging_box"), "");
  const auto& joints = h.app->session.scene().joints;
  const std::string first = base(joints[3]).name;
  const std::string second = base(joints[7]).name;
  EXPECT_EQ(h.app->set("ring", first + ',' + second), "");
  EXPECT_EQ(h.app->desk.ringed, (std::vector<std::string>{first, second}));
  h.frames(1);
  EXPECT_EQ(h.app->set("ring", first + ",nowhere"), "no joint is called 'nowhere'");
  EXPECT_EQ(h.app->desk.ringed.size(), 2U) << "unchanged";
  EXPECT_EQ(h.app->set("ring", ""), "no joint is called ''");
  h.app->reset();
  EXPECT_EQ(h.app->desk.ringed.size(), 2U) << "the same joints";
  EXPECT_EQ(h.app->set("ring", "none"), "");
  EXPECT_TRUE(h.app->desk.ringed.empty());
  EXPECT_EQ(h.app->set("ring", second), "");
  ASSERT_EQ(h.app->set("scene", "bridge"), "");
  EXPECT_TRUE(h.app->desk.ringed.empty()) << "another scene, other joints";
}

TEST(Link, RingsAJointWithACommaInItsName) {
  Headless h;
  SceneBuilder builder("comma");
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {0.0, -1.0, 0.0});
  builder.joint(builder.add_ball_joint(ball, kWorld, Vec3::Zero())).name = "left,right";
  h.app->open_text(write_scene(*builder.build()), "comma.json");
  EXPECT_EQ(h.app->set("ring", "left,right"), "");
  EXPECT_EQ(h.app->desk.ringed, std::vector<std::string>{"left,right"});
}

// `forces` is both a switch of the view and a setting.
TEST(Link, OpensEverySetting) {
  Headless h;
  h.app->open_link(
      make_link(*shipped("bridge"), experiment_of(*shipped("bridge"), test::unusual())));
  EXPECT_TRUE(h.app->trouble.title.empty());
  Settings wanted = test::unusual();
  wanted.watch_stiffness = h.app->session.settings().watch_stiffness;  // by the view's tint
  EXPECT_EQ(h.app->session.settings(), wanted);
  EXPECT_EQ(h.app->set("forces", "on"), "");
  EXPECT_TRUE(h.app->desk.view.forces);
  EXPECT_EQ(h.app->session.settings(), wanted);
}

TEST(Link, AlwaysNamesTheMethod) {
  const auto scene = shipped("swinging_box");
  EXPECT_EQ(make_link(*scene, experiment_of(*scene, scene->settings)),
            "scene=swinging_box&solver=bpp&mode=adaptive&alpha=0.1&n=16&integrator=euler");
}

TEST(Link, SceneIsAppliedFirstInAnyOrder) {
  Headless h;
  h.app->open_link("mode=damping&scene=heavy_stack");
  EXPECT_EQ(h.app->session.scene().name, "heavy_stack");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);
}

TEST(Link, InvalidPartsAreReportedAndTheRestApplies) {
  Headless h;
  h.app->open_link("mode=warp&alpha=7&n=5&nonsense&scene=nowhere");
  EXPECT_EQ(h.app->trouble.problems.size(), 4U);
  EXPECT_EQ(h.app->session.settings().n, 5);
  EXPECT_EQ(h.app->session.scene().name, "swinging_box");
}

// The card states what was applied, and lists every invalid part.
TEST(Link, TheOutcomeOfEveryPartIsReported) {
  const std::string rest = "The rest of the link was applied.";
  Headless h;
  const auto aftermath = [&](const char* link) {
    h.app->trouble = {};
    h.app->open_link(link);
    h.frames(2);
    return h.app->trouble.aftermath;
  };
  EXPECT_EQ(aftermath("scene=bridge&alpha=7"), rest);
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(aftermath("scene=nowhere&n=5"), std::string(kSceneKept) + " " + rest);
  EXPECT_EQ(aftermath("scene=nowhere"), kSceneKept);
  EXPECT_EQ(aftermath("scene=nowhere&scene=pendulum"), rest);
  EXPECT_EQ(h.app->session.scene().name, "pendulum");
  EXPECT_EQ(aftermath("alpha=7"), "") << "a scene inside the link may have been opened before";
  EXPECT_EQ(aftermath("#=5"), "");
  ASSERT_EQ(h.app->trouble.problems.size(), 1U);
  EXPECT_EQ(h.app->trouble.problems[0].pointer, "=5");
}

TEST(Link, AnyTextIsAccepted) {
  for (const char* text : {"", "#", "&&&", "=", "%", "%4", "%zz=%00", "a=b=c", "\xff\xfe"}) {
    EXPECT_NO_THROW(parse_link(text)) << text;
  }
  EXPECT_EQ(parse_link("scene=a%00%1f%7F%41")[0].value, "a%00%1f%7FA")
      << "control characters stay escaped, so that they cannot truncate a message";
  const auto parts = parse_link("#scene=my%20scene&x");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].value, "my scene");
  EXPECT_EQ(parts[1].key, "x");
}

TEST(Link, RoundTripKeepsEveryPartOfAnExperiment) {
  const auto scene = shipped("bridge");
  Experiment experiment = experiment_of(*scene, scene->settings, 7);
  experiment.settings.mode = Mode::kCapped;
  experiment.settings.alpha = 0.1 / 3.0;
  experiment.settings.warm_start = true;
  experiment.settings.solver = SolverKind::kPgs;
  experiment.duration = 1.0 / 3.0;
  experiment.load = 0.3;
  Headless h;
  h.app->open_link(make_link(*scene, experiment));
  EXPECT_TRUE(h.app->trouble.title.empty());
  Settings wanted = experiment.settings;
  wanted.watch_stiffness = h.app->session.settings().watch_stiffness;  // by the view's tint
  EXPECT_EQ(h.app->session.settings(), wanted);
  EXPECT_EQ(h.app->pause_at, experiment.duration);
  EXPECT_EQ(h.app->load, experiment.load);
  EXPECT_EQ(h.app->seed, experiment.seed);
}

TEST(Link, ProblemsOfAnExperimentAreReported) {
  Headless h;
  h.app->open_link("scene=bridge&alpha=7&seconds=x&load=-1&seed=0.5");
  EXPECT_EQ(h.app->trouble.problems.size(), 4U);
}

TEST(Link, ASeedIsAWholeNumber) {
  Headless h;
  for (const char* seed : {"0.5", "-1", "1e9", "x", ""}) {
    EXPECT_NE(h.app->set("seed", seed), "") << seed;
  }
  EXPECT_EQ(h.app->seed, 0);
  EXPECT_EQ(h.app->set("seed", "3"), "");
  EXPECT_EQ(h.app->seed, 3);
}

// The same experiment in the window and in the lab.
TEST(Link, TheWindowRunsTheExperimentOfALink) {
  const auto scene = shipped("pendulum");
  Experiment experiment = experiment_of(*scene, scene->settings, 3);
  experiment.settings.mode = Mode::kConst;
  experiment.settings.n = 5;
  experiment.duration = 0.5;
  experiment.load = 2.0;
  const Reference reference = find_reference(scene, 0.5);
  ExperimentRun run(*scene, experiment, reference);
  while (run.advance()) {
  }
  Headless h;
  h.app->open_link(make_link(*scene, experiment));
  EXPECT_TRUE(h.app->trouble.title.empty());
  h.app->session.play();
  h.frames(60);
  EXPECT_FALSE(h.app->session.playing()) << "it pauses where the experiment ends";
  EXPECT_EQ(h.app->session.hash(), run.result().metrics.hash);
  EXPECT_NE(h.app->link().find("load=2&seed=3"), std::string::npos) << h.app->link();
}

// On the way to a moment that takes long the controls of the run still work.
TEST(Link, ToAMomentGivesWayToTheUser) {
  constexpr double kFar = 1e4;  // [s]
  Headless h;
  Session& session = h.app->session;
  const auto taken_over_by = [&](const auto& act) {
    h.app->reset();
    h.app->seek(kFar);
    h.frames(2);
    EXPECT_TRUE(h.app->seeking());
    EXPECT_GT(session.state().frame, 0);
    act();
    h.frames(2);
    EXPECT_FALSE(h.app->seeking());
  };
  taken_over_by([&] { session.play(); });
  EXPECT_TRUE(session.playing());
  taken_over_by([&] { session.go_to(session.timeline().at_time(0.0)); });
  EXPECT_EQ(session.state().frame, 0);
}

// The moment is computed again, with what the user did, and shown from the same place.
TEST(Link, ToAMomentHasItsTimeItsEventsAndItsCamera) {
  Headless h;
  ASSERT_EQ(h.app->set("scene", "bridge"), "");
  Session& session = h.app->session;
  session.pause();
  for (int i = 0; i < 20; ++i) session.step();
  session.throw_ball({{0.0, 9.0, 3.0}, {0.0, 0.0, -2.0}});
  for (int i = 0; i < 33; ++i) session.step();
  h.app->view.camera.orbit(0.4, 0.1);
  h.app->view.camera.zoom(1.7);
  h.frames(120);  // it arrives
  std::string more;
  h.app->host.copy_link = [&](const std::string& parts) { more = parts; };
  ASSERT_EQ(h.app->set("menu", "share"), "");
  h.frames(3);
  h.press("Copy link to this moment and view");
  EXPECT_TRUE(more.starts_with("&at=0.88333")) << more;

  Headless other;
  other.app->session.play();
  other.app->open_link(h.app->link() + more);
  EXPECT_EQ(other.app->trouble.title, "");
  EXPECT_TRUE(other.app->seeking());
  for (int i = 0; i < 1000 && other.app->seeking(); ++i) other.frames(1);
  EXPECT_FALSE(other.app->session.playing());
  EXPECT_EQ(other.app->session.state().frame, 53);
  EXPECT_EQ(other.app->session.hash(), session.hash());
  const auto eye = [](const Headless& of) { return of.app->view.camera.eye(of.app->view_rect); };
  EXPECT_LT((eye(other) - eye(h)).norm(), 0.02);
  EXPECT_EQ(other.app->link().find("camera"), std::string::npos) << "it is not kept in the address";
}

TEST(Link, RefusesATimeOrACameraThatIsNone) {
  Headless h;
  const std::string before = h.app->view.camera.text();
  for (const char* text :
       {"", "1", "1,2", "0,0,10,0,0", "0,0,10,0,0,0,0", "0,0,10,0,0,nan", "0,2,10,0,0,0",
        "0,0,-1,0,0,0", "0,0,0,0,0,0", "0,0,1e9,0,0,0", ",,,,,"}) {
    EXPECT_NE(h.app->set("camera", text), "") << text;
    EXPECT_EQ(h.app->view.camera.text(), before) << text;
  }
  for (const char* text : {"", "-1", "0", "nan", "1e9", "soon"}) {
    EXPECT_NE(h.app->set("at", text), "") << text;
    EXPECT_FALSE(h.app->seeking()) << text;
  }
}

TEST(Link, ATimeIsLeftWhenAnotherRunBegins) {
  Headless h;
  ASSERT_EQ(h.app->set("at", "500"), "");
  h.frames(2);
  EXPECT_TRUE(h.app->seeking());
  h.app->reset();
  EXPECT_FALSE(h.app->seeking());
}

// A command names the edited scene, and so does a link with too many events. Links of this kind
// predate events and are still supported.
TEST(Link, OfAnEditedSceneIsOpened) {
  for (const char* name : {"swinging_box", "bridge", "heavy_stack", "ragdoll_drop"}) {
    for (const char* edit : {"ball", "joints", "contact", "friction", "gravity"}) {
      Headless h;
      ASSERT_EQ(h.app->set("scene", name), "");
      Session& session = h.app->session;
      for (int i = 0; i < 30; ++i) session.step();
      EXPECT_FALSE(is_own(h.app->link_scene()));
      Ball ball;
      ball.position = Vec3(0.0, 9.0, 0.0);
      if (std::string_view(edit) == "ball") {
        session.throw_ball(ball);
      } else {
        Effects effects = session.scene().effects;
        for (const EffectEntry& effect : kEffects) {
          if (effect.name == edit) effects.*effect.member = false;
        }
        if (effects == session.scene().effects) continue;
        session.set_effects(effects);
      }
      ASSERT_NE(session.edition(), nullptr) << name << " " << edit;
      const Scene edited = *session.edition()->start;
      const std::string link = h.app->link();
      for (int i = 0; i < 10; ++i) session.step();
      EXPECT_EQ(h.app->link(), link) << "it does not change with every frame";
      const SceneResult read = read_scene(write_scene(edited));
      ASSERT_TRUE(read.scene) << name << " " << edit << ": " << to_string(read.problems.front());
      Effects acting = session.scene().effects;
      if (!acting.contact) acting.friction = acting.restitution = false;  // they act in contacts
      EXPECT_EQ(read.scene->effects, acting) << name << " " << edit;
      EXPECT_EQ(read.scene->bodies.size(), session.scene().bodies.size());
      EXPECT_NE(h.app->command().find(read.scene->name + ".json"), std::string::npos);
      Headless other;
      other.app->open_link("alpha=0.1", read_scene(write_scene(edited)));
      EXPECT_EQ(other.app->trouble.title, "") << name << " " << edit;
      EXPECT_EQ(other.app->session.scene().bodies.size(), edited.bodies.size());
      session.go_to(10);
      EXPECT_EQ(h.app->link().find("events="), std::string::npos) << "before the edit";
    }
  }
}

TEST(Link, OfASceneWithoutOneOfItsEffectsIsOpened) {
  SceneBuilder builder("arm");
  const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0, {0.5, 0.0, 0.0});
  const int hinge = builder.add_hinge(rod, kWorld, Vec3::Zero(), Vec3::UnitZ());
  builder.limit(hinge, -1.0, 1.0, 0.5);
  builder.drive(hinge, 2.0, 1.0);
  builder.add_spring(hinge, {.stiffness = 3.0});
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {2.0, 0.0, 0.0});
  builder.add_rope(ball, rod, {2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.5);
  for (const EffectEntry& effect : kEffects) {
    Session session(builder.build());
    for (int i = 0; i < 5; ++i) session.step();
    Effects effects = session.scene().effects;
    if (!(effects.*effect.member)) continue;
    effects.*effect.member = false;
    session.set_effects(effects);
    ASSERT_NE(session.edition(), nullptr) << effect.name;
    const SceneResult read = read_scene(write_scene(*session.edition()->start));
    ASSERT_TRUE(read.scene) << effect.name << ": " << to_string(read.problems.front());
  }
}

}  // namespace
}  // namespace substep
