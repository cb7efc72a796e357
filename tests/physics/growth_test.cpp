// Growth of the work of a sub-step with the size of a scene: counted operations, the same on every
// machine. `./dev bench` measures the times.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/sim/simulator.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {
namespace {

constexpr int kFrames = 5;

struct Work {
  double operations = 0.0;  // of a sub-step, 16 to a frame
  double contacts = 0.0;    // in the last frame
};

/// @param settled frames that are not counted
Work work_of(const Scene& scene, SolverKind solver, int settled = 0) {
  Settings settings = scene.settings;
  settings.solver = solver;
  settings.mode = Mode::kConst;
  settings.n = 16;
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(settings);
  Work work;
  for (int i = 0; i < settled + kFrames; ++i) {
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.status, StepStatus::kOk);
    if (i >= settled) work.operations += static_cast<double>(report.work.flops) / (kFrames * 16);
    work.contacts = report.contact_rows;
  }
  return work;
}

/// The exponent of the growth of the work with the size of a scene.
double exponent(double size, double work, double larger_size, double larger_work) {
  return std::log(larger_work / work) / std::log(larger_size / size);
}

class Growth : public testing::TestWithParam<SolverKind> {};

INSTANTIATE_TEST_SUITE_P(EverySolver, Growth, testing::Values(SolverKind::kBpp, SolverKind::kPgs),
                         [](const auto& of) {
                           return of.param == SolverKind::kBpp ? "Bpp" : "Pgs";
                         });

TEST_P(Growth, RopesAreLinear) {
  const auto work = [&](int links) {
    return work_of(scenes::rope_of_n({.n = links}), GetParam()).operations;
  };
  EXPECT_LT(exponent(25, work(25), 400, work(400)), 1.01);
}

// After the contacts carry load: while they close one by one, every pivot refactors down to the
// floor.
TEST_P(Growth, StacksAreNearlyLinear) {
  const auto work = [&](int layers) {
    return work_of(scenes::heavy_stack({.layers = layers}), GetParam(), 1).operations;
  };
  EXPECT_LT(exponent(5, work(5), 40, work(40)), 1.1);
}

// The bricks of a wall are a planar graph. With n contacts its elimination takes n^1.5 in the best
// order, and n^2 course by course; the work of Gauss-Seidel is proportional to the contacts.
TEST_P(Growth, WallsGrowLikeAPlanarGraph) {
  const auto work = [&](int courses) {
    return work_of(scenes::wall({.courses = courses, .bricks = 2 * courses}), GetParam());
  };
  const Work small = work(4);
  const Work large = work(10);
  EXPECT_GT(large.contacts, 2000);
  EXPECT_LT(exponent(small.contacts, small.operations, large.contacts, large.operations),
            GetParam() == SolverKind::kBpp ? 1.6 : 1.1);
}

}  // namespace
}  // namespace substep::test
