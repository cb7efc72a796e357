#include "app/history.hpp"

#include <gtest/gtest.h>

namespace substep {
namespace {

FrameReport report_at(int frame) {
  FrameReport report;
  report.frame = frame;
  report.time = frame / 60.0;
  report.n_substeps = frame % 7;
  report.energy = 100.0 + frame;
  return report;
}

TEST(History, KeepsOneSampleAFrameWithItsTime) {
  History history;
  history.start(report_at(0), 1.0 / 60.0);
  for (int i = 1; i <= 120; ++i) history.add(report_at(i));
  ASSERT_EQ(history.size(), 120U);
  EXPECT_NEAR(history.end_time(), 2.0, 1e-12);
  EXPECT_NEAR(history.time(0), 1.0 / 60.0, 1e-12);
  EXPECT_EQ(history[Channel::kSubsteps][6], 0.0F);
  EXPECT_FLOAT_EQ(history[Channel::kEnergyChange][9], 10.0F);
}

TEST(History, ForgetsTheOldestAndKeepsItsTimes) {
  History history;
  history.start(report_at(0), 1.0 / 60.0);
  const int frames = static_cast<int>(History::kCapacity) + 5000;
  for (int i = 1; i <= frames; ++i) history.add(report_at(i));
  EXPECT_LE(history.size(), History::kCapacity);
  EXPECT_GE(history.size(), History::kCapacity - History::kCapacity / 10);
  EXPECT_NEAR(history.end_time(), frames / 60.0, 1e-6);
  EXPECT_FLOAT_EQ(history[Channel::kSubsteps].back(), static_cast<float>(frames % 7));
}

}  // namespace
}  // namespace substep
