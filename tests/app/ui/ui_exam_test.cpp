#include <gtest/gtest.h>

#include "app/lab/exam_ghost.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(ExamGhost, ScenesHaveTheirOwnGroup) {
  Library library = shipped();
  const std::size_t before = library.scenes().size();
  const std::string first = library.scenes().front()->name;
  add_exam(library);
  EXPECT_GE(library.scenes().size(), before + 14);
  EXPECT_EQ(library.scenes().front()->name, first);
  ASSERT_NE(library.find("exam_four_bar"), nullptr);
  EXPECT_EQ(group_title(library.find("exam_four_bar")->group), "Benchmarks with known solutions");
  EXPECT_FALSE(is_own(*library.find("exam_four_bar")));
}

TEST(ExamGhost, MovesAsTheSceneShould) {
  Headless h;
  add_exam(h.app->library);
  ASSERT_TRUE(h.app->open("exam_revolute"));
  h.app->session.play();
  h.frames(60);
  EXPECT_EQ(h.renderer->picture.ghost_boxes.size(), 1U);
  EXPECT_GT(h.app->session.state().time, 0.8);
  const Poses* exact = h.app->exam.at(h.app->session);
  ASSERT_NE(exact, nullptr);
  // The run's poses between two frames are interpolated linearly: an error of a millimetre at 6
  // m/s.
  EXPECT_LT((exact->x[0] - h.app->session.poses().x[0]).norm(), 5e-3);
  EXPECT_GT((exact->x[0] - h.app->session.scene().bodies[0].position).norm(), 1.0);

  h.app->session.pause();
  h.app->session.go_to(0);
  h.frames(2);
  exact = h.app->exam.at(h.app->session);
  ASSERT_NE(exact, nullptr);
  EXPECT_LT((exact->x[0] - h.app->session.poses().x[0]).norm(), 1e-9) << "back in time as well";
}

TEST(ExamGhost, ExistsOnlyForAnUnchangedScene) {
  Headless h;
  add_exam(h.app->library);
  h.frames(2);
  EXPECT_EQ(h.app->exam.at(h.app->session), nullptr) << "swinging box";
  h.app->open("exam_compliant_ball");
  EXPECT_NE(h.app->exam.at(h.app->session), nullptr);
  h.app->open("exam_hard_clutter");
  EXPECT_EQ(h.app->exam.at(h.app->session), nullptr) << "its motion is unknown";
  Scene heavier = *h.app->library.find("exam_revolute");
  heavier.bodies[0].mass *= 2.0;
  h.app->run(std::make_shared<const Scene>(heavier));
  EXPECT_EQ(h.app->exam.at(h.app->session), nullptr) << "another load";
}

TEST(ExamGhost, GivesWayToAComparison) {
  Headless h;
  add_exam(h.app->library);
  h.app->open("exam_revolute");
  h.app->compare.start(h.app->session, {Overrides{}, Overrides{}});
  h.frames(2);
  EXPECT_EQ(h.renderer->picture.ghost_boxes.size(), 2U);
}

}  // namespace
}  // namespace substep
