// Long runs: nothing drifts beyond its bound, and memory does not grow. 50,000 frames by default;
// SUBSTEP_LONG_FRAMES=1000000 for an overnight run.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>

#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

std::int64_t frames() {
  const char* text = std::getenv("SUBSTEP_LONG_FRAMES");
  return text ? std::atoll(text) : 50000;
}

/// Peak memory of the program so far [KiB].
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

struct LongRun {
  double energy_after_warm_up = 0.0;  // [J]
  double energy_highest = 0.0;        // after it [J]
  double energy_lowest = 0.0;         // after it [J]
  double joint_gap = 0.0;             // largest after it [m]
  long memory_growth = 0;             // after it [KiB]
  StepStatus status = StepStatus::kOk;
};

/// @param warm_up frames that are not checked
LongRun run_long(const Scene& scene, const Settings& settings, std::int64_t warm_up) {
  Simulator simulator = simulator_of(scene, settings);
  LongRun out;
  long memory = 0;
  for (std::int64_t i = 0; i < frames() && out.status == StepStatus::kOk; ++i) {
    const FrameReport report = simulator.step();
    out.status = report.status;
    if (i < warm_up) continue;
    if (i == warm_up) {
      memory = peak_memory();
      out.energy_after_warm_up = out.energy_highest = out.energy_lowest = report.energy;
    }
    keep_largest(out.energy_highest, report.energy);
    out.energy_lowest = std::min(out.energy_lowest, report.energy);
    keep_largest(out.joint_gap, report.joint_gap);
  }
  out.memory_growth = peak_memory() - memory;
  std::printf("%s, %lld frames: energy %+.6g to %+.6g J of %.6g J, gap %.3g m, %ld KiB more\n",
              scene.name.c_str(), static_cast<long long>(frames()),
              out.energy_lowest - out.energy_after_warm_up,
              out.energy_highest - out.energy_after_warm_up, out.energy_after_warm_up,
              out.joint_gap, out.memory_growth);
  return out;
}

constexpr long kMemoryRoom = 1024;  // allowance for the test's own output and the allocator [KiB]

TEST(LongRun, TheSwingingBoxKeepsItsEnergyWithLeapfrog) {
  const Scene scene = scenes::swinging_box();
  const LongRun r = run_long(scene, {.integrator = Integrator::kLeapfrog}, 60);
  ASSERT_EQ(r.status, StepStatus::kOk);
  // In 200 s the energy stays within 0.001 % of the exchanged energy; the bound is twice that for
  // each 200 s.
  const double bound = 2.0 * 1e-5 * *scene.criteria.energy_scale *
                       (1.0 + static_cast<double>(frames()) * scene.frame / 200.0);
  EXPECT_LT(r.energy_highest - r.energy_after_warm_up, bound);
  EXPECT_GT(r.energy_lowest - r.energy_after_warm_up, -bound);
  EXPECT_LT(r.joint_gap, 1e-3);
  EXPECT_LT(r.memory_growth, kMemoryRoom);
}

TEST(LongRun, TheBridgeComesToRestWithCappedDamping) {
  const Scene scene = scenes::bridge();
  const LongRun r = run_long(scene, {.mode = Mode::kCapped}, 600);  // the ball has left and landed
  ASSERT_EQ(r.status, StepStatus::kOk);
  EXPECT_LT(r.energy_highest - r.energy_after_warm_up, 1.0) << "no energy is added";
  EXPECT_LT(r.joint_gap, 1e-2);
  EXPECT_LT(r.memory_growth, kMemoryRoom);
}

// With the paper's scheme the empty bridge does not come to rest: the full drift law corrects the
// error of a long sub-step in a short one, and with N changing from frame to frame the planks keep
// shaking at some hundred joules. They stay intact, and the energy stays bounded.
TEST(LongRun, TheEmptyBridgeKeepsShakingWithThePapersScheme) {
  const Scene scene = scenes::bridge();
  const LongRun r = run_long(scene, scene.settings, 600);
  ASSERT_EQ(r.status, StepStatus::kOk);
  EXPECT_GT(r.energy_highest - r.energy_after_warm_up, 1.0) << "it has come to rest after all";
  EXPECT_LT(r.energy_highest - r.energy_after_warm_up, 3000.0);
  EXPECT_LT(r.joint_gap, 1e-2);
  EXPECT_LT(r.memory_growth, kMemoryRoom);
}

}  // namespace
}  // namespace substep::test
