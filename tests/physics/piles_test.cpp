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

// Contacts yield to their force by up to 1.5e-7 m in each of these frames. Once the deepest overlap
// exceeds 1e-4 of the half width, they are parted.
TEST(Piles, OverlapsOfARestingPyramidStayBelowTheAllowedOne) {
  constexpr double kAllowed = 5e-5;
  const Scene scene = pyramid_of(15, 0.5);
  EXPECT_GT(run_pile(scene, 300).overlap, 0.5 * kAllowed) << "contacts do not yield at all";
  const Pile pile = run_pile(scene, 700);
  EXPECT_LT(pile.overlap, 1.05 * kAllowed);
  EXPECT_EQ(pile.unsolved, 0);
  EXPECT_LT(pile.kinetic, 1e-5);
}

}  // namespace
}  // namespace substep::test
