// A bounded number of the values of a run of any length.

#include "core/lab/bounded_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace substep {
namespace {

constexpr int kMost = static_cast<int>(BoundedSample::kMost);

TEST(BoundedSample, KeepsAllValuesOfAShortRun) {
  BoundedSample sample;
  EXPECT_EQ(sample.quantile(0.5), 0.0);
  for (int i = 0; i < kMost; ++i) sample.add(kMost - i);
  ASSERT_EQ(sample.values().size(), BoundedSample::kMost);
  EXPECT_EQ(sample.values().front(), kMost);
  EXPECT_EQ(sample.quantile(0.0), 1.0);
  EXPECT_EQ(sample.quantile(0.5), kMost / 2 + 1) << "the upper of two";
  EXPECT_EQ(sample.quantile(1.0), kMost);
}

TEST(BoundedSample, SamplesALongRunEvenly) {
  constexpr int kValues = 1'000'000;
  BoundedSample ramp;
  BoundedSample swing;  // with a period that divides every power of two
  for (int i = 0; i < kValues; ++i) {
    ramp.add(i);
    swing.add(i % 64);
  }
  EXPECT_EQ(ramp.values().size(), BoundedSample::kMost);
  for (const double share : {0.05, 0.5, 0.95}) {
    EXPECT_NEAR(ramp.quantile(share) / kValues, share, 0.015) << share;
    EXPECT_NEAR(swing.quantile(share) / 64, share, 0.03) << share;
  }
}

}  // namespace
}  // namespace substep
