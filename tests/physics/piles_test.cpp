// Piles of boxes with the default settings: most of their contact rows are redundant.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"

namespace substep::test {
namespace {

/// Rows of cubes of 1 m and 1 kg, each on two of the row below: n (n + 1)/2 of them.
Scene pyramid_of(int rows, double friction) {
  SceneBuilder builder("pyramid");
  builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = friction;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < rows - row; ++i) {
      const Vec3 place{1.05 * (i + 0.5 * (row - rows)), 0.5 + row, 0.0};
      builder.body(builder.add_body(Box{{0.5, 0.5, 0.5}}, 1.0, place)).friction = friction;
    }
  }
  Scene scene = *builder.build();
  scene.settings = substep::Settings{};
  return scene;
}

struct Pile {
  std::int64_t unsolved = 0;
  std::int64_t factorisations = 0;
  std::int64_t substeps = 0;
  double overlap = 0.0;  // largest [m]
  double kinetic = 0.0;  // at the end [J]
};

Pile run_pile(const Scene& scene, int frames) {
  Simulator simulator(std::make_shared<const Scene>(scene));
  Pile pile;
  for (int i = 0; i < frames; ++i) {
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.status, StepStatus::kOk);
    pile.unsolved += report.work.unsolved;
    pile.factorisations += report.work.factorisations;
    pile.substeps += report.n_substeps + report.n_discarded;
    keep_largest(pile.overlap, report.penetration);
    pile.kinetic = report.kinetic;
  }
  return pile;
}

// Which rows push is nearly undetermined, and block pivoting cycles.
TEST(Piles, APyramidOf300CubesIsSolved) {
  const Pile pile = run_pile(pyramid_of(24, 0.5), 90);
  EXPECT_LE(pile.unsolved, 2) << "of some 100 solves";
  EXPECT_LT(pile.factorisations, 40 * pile.substeps);
  EXPECT_LT(pile.overlap, 1e-4);
  EXPECT_LT(pile.kinetic, 1e-3);
}

// A ball breaks through: most rows slide, and many are redundant.
TEST(Piles, AWallThatIsStruckIsSolved) {
  Scene scene = scenes::wall({});
  scene.settings = substep::Settings{};
  const Pile pile = run_pile(scene, 100);
  EXPECT_LT(5 * pile.unsolved, pile.substeps);
}

// Cards slip and meet within sub-steps, which are then solved again: from the rows at their bounds
// of the solve before, not of the last sub-step.
TEST(Piles, ARepeatedSolveStartsFromTheLastOne) {
  Scene scene = scenes::card_house();
  scene.settings = substep::Settings{};
  const Pile pile = run_pile(scene, 120);
  EXPECT_LT(pile.factorisations, 12 * pile.substeps);
}

// Contacts yield until their overlap carries the rest of the force: then the pile is at rest.
TEST(Piles, ARestingPyramidStopsSinking) {
  const Scene scene = pyramid_of(10, 0.5);
  const Pile early = run_pile(scene, 240);
  const Pile late = run_pile(scene, 600);
  EXPECT_GT(early.overlap, 1e-7) << "contacts do not yield at all";
  EXPECT_LT(late.overlap, 1.2 * early.overlap);
  EXPECT_LT(late.overlap, 5e-6);
  EXPECT_EQ(late.unsolved, 0);
  EXPECT_LT(late.kinetic, 1e-20);
}

// Sliding at the speed of rounding errors has no direction: tangents that followed it would change
// the forces, and with them the rows at their bounds, in every sub-step for ever.
void expect_steady_forces(const Scene& scene) {
  Simulator simulator(std::make_shared<const Scene>(scene));
  for (int i = 0; i < 150; ++i) simulator.step();
  for (int i = 0; i < 10; ++i) {
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.work.pivots, 0);
    EXPECT_EQ(report.work.solves, report.n_substeps);
    EXPECT_LT(report.kinetic, 1e-20);
  }
}

TEST(Piles, ARestingPyramidKeepsItsForces) { expect_steady_forces(pyramid_of(15, 0.5)); }

/// Boxes of unequal sizes, moments and masses on a plane, each turned against the one below.
Scene tower(int boxes, const Quat& slope, double turn) {
  SceneBuilder builder("tower");
  const int plane = builder.add_fixed(Plane{}, Vec3::Zero());
  builder.body(plane).orientation = slope;
  builder.body(plane).friction = 0.8;
  double top = 0.0;
  for (int i = 0; i < boxes; ++i) {
    const double half = 0.1 + 0.03 * (i % 3);
    const Vec3 place{0.02 * (i % 2), top + half, 0.01 * (i % 3)};
    const int box = builder.add_body(Box{{0.6 - 0.03 * i, half, 0.4 + 0.02 * (i % 4)}},
                                     1.0 + 7.0 * (i % 2), slope * place);
    builder.body(box).orientation = slope * Quat(Eigen::AngleAxisd(turn * i, Vec3::UnitY()));
    builder.body(box).friction = 0.8;
    top += 2.0 * half;
  }
  Scene scene = *builder.build();
  scene.settings = substep::Settings{};
  return scene;
}

TEST(Piles, RestingTowersKeepTheirForces) {
  expect_steady_forces(tower(10, Quat::Identity(), 0.3));
  const Vec3 axis = Vec3{1.0, 0.0, 0.7}.normalized();
  expect_steady_forces(tower(4, Quat(Eigen::AngleAxisd(0.2, axis)), 0.0));
}

// A box on a slope, which friction holds: neither it nor the contacts creep.
TEST(Piles, ABoxOnASlopeDoesNotCreep) {
  SceneBuilder builder("slope");
  const Quat tilt(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  const int slope = builder.add_fixed(Plane{}, Vec3::Zero());
  builder.body(slope).orientation = tilt;
  builder.body(slope).friction = 0.8;
  const int box = builder.add_body(Box{{0.5, 0.3, 0.4}}, 2.0, tilt * Vec3{0.0, 0.3, 0.0});
  builder.body(box).orientation = tilt;
  builder.body(box).friction = 0.8;
  Scene scene = *builder.build();
  scene.settings = substep::Settings{};
  scene.settings.sleep = false;
  Simulator simulator(std::make_shared<const Scene>(scene));
  for (int i = 0; i < 120; ++i) simulator.step();
  const Vec3 then = simulator.state().x[index(box)];
  for (int i = 0; i < 600; ++i) ASSERT_EQ(simulator.step().status, StepStatus::kOk);
  EXPECT_LT((simulator.state().x[index(box)] - then).norm(), 1e-9);
}

// Limbs lie across each other and the floor: loops of joints and contacts, in which the bounds of
// friction swing. Joints that did not close doubled N until the budget was spent.
TEST(Piles, RagdollsThatFallOnEachOtherNeedFewSubsteps) {
  Scene scene = scenes::ragdoll_drop();
  scene.settings = substep::Settings{};
  Simulator simulator(std::make_shared<const Scene>(scene));
  int most = 0;
  double gap = 0.0;
  for (int i = 0; i < 240; ++i) {
    const FrameReport report = simulator.step();
    ASSERT_EQ(report.status, StepStatus::kOk) << "frame " << i;
    most = std::max(most, report.n_substeps);
    keep_largest(gap, report.joint_gap);
  }
  EXPECT_LE(most, 40);
  EXPECT_LT(gap, 1e-9);
}

}  // namespace
}  // namespace substep::test
