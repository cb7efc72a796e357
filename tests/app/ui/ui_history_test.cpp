#include "app/lab/history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace substep {
namespace {

FrameReport report_at(int frame) {
  FrameReport report;
  report.frame = frame;
  report.time = frame / 60.0;
  report.n_substeps = frame % 7;
  report.kinetic = 3.0;
  report.potential = 97.0 + frame;
  report.energy = report.kinetic + report.potential;
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
  EXPECT_FLOAT_EQ(history[Channel::kTotal][9], 13.0F);
  EXPECT_FLOAT_EQ(history[Channel::kDrift][9], 10.0F);
}

TEST(History, TheZeroOfThePotentialNeverMoves) {
  for (const double exchanged : {0.0, 15.0}) {
    History history;
    history.start(report_at(0), 1.0 / 60.0, exchanged);
    for (int i = 1; i <= 60; ++i) {
      FrameReport report = report_at(i);
      report.potential = 97.0 - i;  // below that of any frame before, and below what was stated
      history.add(report);
      ASSERT_DOUBLE_EQ(history.potential_offset(), exchanged) << i;
    }
    history.cut(0.1);
    EXPECT_DOUBLE_EQ(history.potential_offset(), exchanged);
  }
}

TEST(History, WorkOfTheUserIsNoDrift) {
  History history;
  history.start(report_at(0), 1.0 / 60.0);
  history.add(report_at(1), 0.75);
  EXPECT_FLOAT_EQ(history[Channel::kDrift][0], 0.25F);
  EXPECT_FLOAT_EQ(history[Channel::kPutIn][0], 0.75F);
  EXPECT_FLOAT_EQ(history[Channel::kTotal][0], 4.0F) << "all of the energy";
}

TEST(History, DropsTheOldestSamplesAndKeepsTheTimes) {
  History history;
  history.start(report_at(0), 1.0 / 60.0);
  const int frames = static_cast<int>(History::kCapacity) + 5000;
  for (int i = 1; i <= frames; ++i) history.add(report_at(i));
  EXPECT_LE(history.size(), History::kCapacity);
  EXPECT_GE(history.size(), History::kCapacity - History::kCapacity / 10);
  EXPECT_NEAR(history.end_time(), frames / 60.0, 1e-6);
  EXPECT_FLOAT_EQ(history[Channel::kSubsteps].back(), static_cast<float>(frames % 7));
}

TEST(History, TruncatedItContinuesLikeAShorterOne) {
  History straight;
  History rewound;
  straight.start(report_at(0), 1.0 / 60.0);
  rewound.start(report_at(0), 1.0 / 60.0);
  for (int i = 1; i <= 1500; ++i) straight.add(report_at(i));
  for (int i = 1; i <= 1400; ++i) rewound.add(report_at(i));
  rewound.cut(700 / 60.0);
  ASSERT_EQ(rewound.size(), 700U);
  EXPECT_TRUE(std::isnan(rewound.at(Channel::kSubsteps, 701 / 60.0)));
  for (int i = 701; i <= 1500; ++i) rewound.add(report_at(i));
  for (std::size_t first = 0; first < 1500; first += 37) {
    const Extent a = straight.samples(Channel::kSubsteps).extent(first, 1500);
    const Extent b = rewound.samples(Channel::kSubsteps).extent(first, 1500);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
  }
  rewound.cut(-1.0);
  EXPECT_EQ(rewound.size(), 0U);
}

TEST(Samples, ExtentsOfBlocksAreThoseOfTheSamples) {
  Samples samples;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1.0F, 3.0F);
  for (int i = 0; i < 5000; ++i) {
    samples.push_back(i % 97 == 0 ? std::numeric_limits<float>::quiet_NaN() : value(random));
    if (i == 4500) samples.drop_front(Samples::kLargestBlock);
  }
  const auto values = samples.values();
  std::uniform_int_distribution<std::size_t> index(0, values.size());
  for (int trial = 0; trial < 400; ++trial) {
    std::size_t first = index(random);
    std::size_t last = index(random);
    if (first > last) std::swap(first, last);
    Extent each;
    for (std::size_t i = first; i < last; ++i) each.add(values[i]);
    const Extent blocks = samples.extent(first, last);
    EXPECT_EQ(each.low, blocks.low);
    EXPECT_EQ(each.high, blocks.high);
    EXPECT_EQ(each.least_positive, blocks.least_positive);
    EXPECT_EQ(each.empty(), blocks.empty());
  }
}

}  // namespace
}  // namespace substep
