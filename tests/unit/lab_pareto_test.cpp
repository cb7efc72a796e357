// The Pareto front of runs, and the cheapest run within an error.

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "core/lab/pareto.hpp"

namespace substep {
namespace {

TEST(Pareto, IsTheFrontOfBruteForce) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coarse(0, 12);  // ties in both
  for (int round = 0; round < 200; ++round) {
    std::vector<CostAndError> points(static_cast<std::size_t>(round % 40));
    for (auto& p : points) p = {double(coarse(random)), double(coarse(random))};
    const std::vector<bool> front = pareto_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const auto& q : points) {
        const auto& p = points[i];
        beaten = beaten ||
                 (q.cost <= p.cost && q.error <= p.error && (q.cost < p.cost || q.error < p.error));
      }
      EXPECT_EQ(front[i], !beaten) << round << " " << i;
    }
  }
}

TEST(Pareto, CheapestWithinIsOnTheFront) {
  const std::vector<CostAndError> points{{1.0, 1.0}, {2.0, 0.1},  {2.0, 0.05},
                                         {3.0, 0.2}, {4.0, 0.01}, {9.0, 0.01}};
  EXPECT_EQ(cheapest_within(points, 2.0), 0U);
  EXPECT_EQ(cheapest_within(points, 0.5), 2U) << "the more accurate one at equal cost";
  EXPECT_EQ(cheapest_within(points, 0.05), 2U) << "the limit is inclusive";
  EXPECT_EQ(cheapest_within(points, 0.02), 4U);
  EXPECT_EQ(cheapest_within(points, 0.001), std::nullopt);
  EXPECT_EQ(cheapest_within({}, 1.0), std::nullopt);
  const std::vector<bool> front = pareto_front(points);
  for (const double error : {2.0, 0.5, 0.05, 0.02}) {
    EXPECT_TRUE(front[*cheapest_within(points, error)]);
  }
}

TEST(Pareto, MostExactWithinIsCheapestWithinWithTheAxesSwapped) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> coarse(0, 12);
  for (int round = 0; round < 100; ++round) {
    std::vector<CostAndError> points(static_cast<std::size_t>(round % 20));
    std::vector<CostAndError> turned;
    for (auto& p : points) {
      p = {double(coarse(random)), double(coarse(random))};
      turned.push_back({p.error, p.cost});
    }
    for (double limit = -0.5; limit < 13.0; limit += 0.5) {
      EXPECT_EQ(most_exact_within(points, limit), cheapest_within(turned, limit));
    }
  }
}

}  // namespace
}  // namespace substep
