// "Why N": which of the criterion's two terms sets N, in words.

#include <gtest/gtest.h>

#include <string>

#include "app/lab/criterion.hpp"
#include "core/stepping/substep_clock.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// A scene with a force that adds stiffness to a body, and a report in which the same body spins.
class TwoTerms : public testing::Test {
 protected:
  TwoTerms() {
    h.app->run(shipped("pendulum"));
    EXPECT_EQ(h.app->set("mode", "adaptive"), "");
    for (int i = 0; i < 10; ++i) h.app->session.step();
    state = h.app->session.state();
    report = h.app->session.report();
    report.r_rotation = 0.0;
    report.rotation_body = -1;
    settings = h.app->session.settings();
  }

  const Scene& scene() { return h.app->session.scene(); }
  Criterion criterion() { return criterion_of(scene(), settings, state, report); }
  // The body of the stiffness term spins, and its rotation term is `times` its k/M.
  void spin(double times) {
    report.rotation_body = report.leader.body;
    report.r_rotation = times * report.leader.r;
    state.u[static_cast<std::size_t>(report.rotation_body)].tail<3>() = Vec3(0.0, 60.0, 0.0);
  }

  Headless h;
  State state;
  FrameReport report;
  PaperSettings settings;
};

TEST_F(TwoTerms, StiffnessAloneSetsNByThePapersRule) {
  const Criterion c = criterion();
  ASSERT_GE(report.leader.body, 0);
  EXPECT_EQ(c.set_by, CriterionTerm::kStiffness);
  EXPECT_EQ(c.body(), report.leader.body);
  EXPECT_EQ(c.n_stiffness,
            wanted_substeps(scene().frame, stable_step(settings.alpha, report.leader.r)));
  EXPECT_EQ(c.n_rotation, 1);
  EXPECT_EQ(rotation_text(scene(), c), "Rotation: no limit");
}

TEST_F(TwoTerms, TheLargerOneSetsN) {
  spin(0.5);
  EXPECT_EQ(criterion().set_by, CriterionTerm::kStiffness);
  spin(16.0);
  const Criterion c = criterion();
  EXPECT_EQ(c.set_by, CriterionTerm::kRotation);
  EXPECT_EQ(c.n_rotation,
            wanted_substeps(scene().frame, stable_step(settings.alpha, 16.0 * report.leader.r)));
  EXPECT_GE(c.n_rotation, c.n_stiffness);
}

TEST_F(TwoTerms, TheTextNamesTheBodyAndItsRate) {
  spin(16.0);
  const Criterion c = criterion();
  const std::string& name = scene().bodies[static_cast<std::size_t>(c.rotation_body)].name;
  EXPECT_DOUBLE_EQ(c.angular_speed, 60.0);
  EXPECT_EQ(setter_text(scene(), c), name + ", spinning at 60 rad/s now");
  EXPECT_EQ(rotation_text(scene(), c), "Rotation of " + name + ", 60 rad/s now");
  EXPECT_EQ(rotation_meaning(scene(), c),
            "Now 57.3° in a frame; the largest of the last 8 s is used");
  state.rotation.clear();  // as in scenes in which bodies may touch
  EXPECT_EQ(setter_text(scene(), criterion()), name + ", spinning at 60 rad/s");
  EXPECT_EQ(rotation_meaning(scene(), criterion()), "It turns 57.3° in a frame");
  EXPECT_EQ(both_terms_text(c), "stiffness alone N = " + std::to_string(c.n_stiffness) +
                                    ", rotation alone N = " + std::to_string(c.n_rotation));
  spin(0.5);
  EXPECT_EQ(setter_text(scene(), criterion()), name + ", " + degree_of_freedom(report.leader));
}

TEST_F(TwoTerms, ABodyThatOnlySpinsSetsN) {
  spin(1.0);
  state.k.clear();  // no constraint force, or K was not evaluated
  const Criterion c = criterion();
  EXPECT_EQ(c.set_by, CriterionTerm::kRotation);
  EXPECT_EQ(stiffness_text(scene(), c), "Stiffness: none");
}

TEST_F(TwoTerms, SwitchedOffItIsThePapersRuleAlone) {
  settings.rotation_criterion = false;
  const Criterion c = criterion();
  EXPECT_EQ(c.set_by, CriterionTerm::kStiffness);
  EXPECT_EQ(rotation_text(scene(), c), "Rotation: switched off");
  EXPECT_EQ(rotation_meaning(scene(), c), "Only the paper's rule sets N.");
}

TEST(WhyPanel, ShowsBothTermsOfEveryScene) {
  Headless h;
  h.app->desk.tab = Tab::kWhy;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    h.app->session.play();
    for (const char* on : {"true", "false"}) {
      ASSERT_EQ(h.app->set("rotation_criterion", on), "");
      h.frames(4);
    }
    h.resize(390.0F, 844.0F, 2.0F);
    h.frames(2);
    h.resize(1280.0F, 720.0F, 1.0F);
  }
}

// The links of the chain need the same N: one row for all of them, not 25.
TEST(WhyPanel, BodiesThatNeedTheSameNShareABar) {
  Headless h;
  h.app->desk.tab = Tab::kWhy;
  h.app->session.pause();
  for (int i = 0; i < 60; ++i) h.app->session.step();
  h.frames(2);
  int bars = 0;
  std::string names;
  for (const ui::Handle& handle : ui::handles()) {
    if (handle.group != "N by stiffness") continue;
    ++bars;
    names += handle.label + "; ";
  }
  EXPECT_GE(bars, 1);
  EXPECT_LE(bars, 8) << names;
  EXPECT_TRUE(names.find(" to link_") != std::string::npos ||
              names.find(" bodies") != std::string::npos)
      << names;
}

TEST(Controls, OffersTheRotationCriterionWhereNIsChosen) {
  Headless h(1280.0F, 2400.0F);
  h.app->desk.more = true;
  h.app->run(shipped("pendulum"));
  ASSERT_EQ(h.app->set("mode", "adaptive"), "");
  h.frames(3);
  ASSERT_NE(find_handle("Rotation criterion"), nullptr);
  h.press("Rotation criterion");
  EXPECT_FALSE(h.app->session.settings().rotation_criterion);
  EXPECT_NE(h.app->link().find("rotation_criterion=false"), std::string::npos);
  ASSERT_EQ(h.app->set("mode", "const"), "");
  h.frames(3);
  EXPECT_EQ(find_handle("Rotation criterion"), nullptr);
}

}  // namespace
}  // namespace substep
