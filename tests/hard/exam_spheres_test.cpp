// The exam's two cases of 216 spheres, each method at its cheapest passing run. All their runs take
// two minutes: `substep exam`, by night.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/lab/exam.hpp"
#include "scenes/generator/exam.hpp"

namespace substep::test {
namespace {

/// Each of these methods with one of its parameters is within the tolerance.
void expect_passes(ExamCase exam, const std::vector<std::pair<std::string, double>>& runs) {
  const std::vector<ExamMethod> all = std::exchange(exam.methods, {});
  for (const auto& [name, value] : runs) {
    for (const ExamMethod& method : all) {
      if (method.name == name) exam.methods.push_back({name, method.settings, {value}, {}});
    }
  }
  const ExamResult result = run_exam(exam);
  ASSERT_EQ(result.rows.size(), runs.size());
  for (const ExamRow& row : result.rows) {
    EXPECT_TRUE(row.passes) << exam.name << ", " << row.method << ' ' << row.value << ": "
                            << row.errors.front() << ' ' << row.status;
  }
}

TEST(ExamOfSpheres, OverlapNoMoreThanWithTheBestPublishedEngine) {
  expect_passes(scenes::exam_spheres(),
                {{"euler, adaptive", 0.1}, {"leapfrog", 4.0}, {"newton mean", 4.0}, {"pgs", 4.0}});
}

TEST(ExamOfSpheres, KeepTheirEnergyBetterThanWithTheBestPublishedEngine) {
  expect_passes(scenes::exam_elastic_spheres(), {{"euler", 16.0}, {"pgs", 16.0}});
}

}  // namespace
}  // namespace substep::test
