// Memory and work budgets of scenes on the command line.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/io/scene_writer.hpp"
#include "core/model/scene_builder.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

constexpr int kStopped = 3;  // the exit code of a run that cannot continue

/// A file with that many spheres at one point.
std::string spheres_at_one_point(int count) {
  SceneBuilder builder("spheres");
  for (int i = 0; i < count; ++i) builder.add_body(Sphere{0.1}, 1.0, {0, 0, 0});
  const fs::path path = folder() / "spheres.json";
  std::ofstream(path) << write_scene(*builder.build());
  return "\"" + path.string() + "\"";
}

TEST(BudgetFlags, ARunOverBudgetStopsWithTheReason) {
  const std::string scene = spheres_at_one_point(300);
  const std::string sentence =
      "44850 contacts of 300 bodies would need 2.4 GiB for the direct solver; the budget is 512 "
      "MiB";
  const Outcome run = substep("run " + scene + " --frames 1", "ulimit -v 1500000;");
  EXPECT_EQ(run.exit_code, kStopped) << run.err;
  EXPECT_EQ(lines_of(run.out).back(), "fails at 0.000 s: " + sentence);
  const Outcome hash = substep("hash " + scene + " --frames 1", "ulimit -v 1500000;");
  EXPECT_EQ(hash.exit_code, kStopped);
  EXPECT_EQ(hash.out, "");
  EXPECT_EQ(hash.err, "stopped at 0.000 s: " + sentence + "\n");
}

TEST(BudgetFlags, TheProductOfSweepsAndSubstepsIsRefusedAtOnce) {
  const Outcome run =
      substep("run pendulum --frames 1 --solver pgs --iterations 100000 --mode const --n 10000",
              "ulimit -t 10;");
  EXPECT_EQ(run.exit_code, kStopped) << run.err;
  EXPECT_NE(run.out.find("10000 sub-steps of 100000 iterations on "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("operations in a frame; the budget is 2e+10"), std::string::npos);
}

TEST(BudgetFlags, SetTheBudget) {
  const std::string scene = spheres_at_one_point(40);
  EXPECT_EQ(substep("run " + scene + " --frames 1").exit_code, 0);
  const Outcome small = substep("run " + scene + " --frames 1 --memory-budget 4");
  EXPECT_EQ(small.exit_code, kStopped);
  EXPECT_NE(small.out.find("the budget is 4 MiB"), std::string::npos) << small.out;
  const Outcome idle = substep("hash bridge --frames 1 --mode const --n 999 --work-budget 1e6");
  EXPECT_EQ(idle.exit_code, kStopped);
  EXPECT_NE(idle.err.find("the budget is 1e+06"), std::string::npos) << idle.err;
}

TEST(BudgetFlags, RefuseValuesOutOfRange) {
  for (const char* flag : {"--memory-budget 0", "--memory-budget nan", "--memory-budget 1e9",
                           "--work-budget 0", "--work-budget inf"}) {
    const Outcome run = substep(std::string("run pendulum --frames 1 ") + flag);
    EXPECT_NE(run.exit_code, 0) << flag;
    EXPECT_NE(run.err.find("must be from "), std::string::npos) << run.err;
  }
}

TEST(BudgetFlags, ALoadNeverLeavesTheRangeOfMasses) {
  SceneBuilder builder("heavy");
  builder.add_body(Sphere{0.1}, 1e12, {0, 0, 0});
  const fs::path path = folder() / "heavy.json";
  std::ofstream(path) << write_scene(*builder.build());
  const Outcome run = substep("run \"" + path.string() + "\" --frames 1 --load 1e6");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

}  // namespace
}  // namespace substep
