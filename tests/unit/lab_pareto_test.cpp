// The Pareto front of runs, and the cheapest run within an error.

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "core/lab/recommendation.hpp"

namespace substep {
namespace {

TEST(Pareto, IsTheFrontOfBruteForce) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coarse(0, 12);  // ties in both
  for (int round = 0; round < 200; ++round) {
    std::vector<RunPoint> points(static_cast<std::size_t>(round % 40));
    for (auto& p : points) p = {double(coarse(random)), double(coarse(random))};
    mark_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const auto& q : points) {
        const auto& p = points[i];
        beaten = beaten ||
                 (q.cost <= p.cost && q.error <= p.error && (q.cost < p.cost || q.error < p.error));
      }
      EXPECT_EQ(points[i].front, !beaten) << round << " " << i;
    }
  }
}

TEST(Pareto, CheapestWithinIsOnTheFront) {
  std::vector<RunPoint> points{{1.0, 1.0, 0}, {2.0, 0.1, 1},  {2.0, 0.05, 2},
                               {3.0, 0.2, 3}, {4.0, 0.01, 4}, {9.0, 0.01, 5}};
  mark_front(points);
  EXPECT_EQ(cheapest_within(points, 2.0)->result, 0U);
  EXPECT_EQ(cheapest_within(points, 0.5)->result, 2U) << "the more accurate one at equal cost";
  EXPECT_EQ(cheapest_within(points, 0.05)->result, 2U) << "the limit is inclusive";
  EXPECT_EQ(cheapest_within(points, 0.02)->result, 4U);
  EXPECT_FALSE(cheapest_within(points, 0.001));
  EXPECT_FALSE(cheapest_within({}, 1.0));
  for (const double error : {2.0, 0.5, 0.05, 0.02}) {
    EXPECT_TRUE(cheapest_within(points, error)->front);
  }
}

TEST(Pareto, MostExactWithinIsCheapestWithinWithTheAxesSwapped) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> coarse(0, 12);
  for (int round = 0; round < 100; ++round) {
    std::vector<RunPoint> points(static_cast<std::size_t>(round % 20));
    std::vector<RunPoint> turned;
    for (auto& p : points) {
      p = {double(coarse(random)), double(coarse(random)), turned.size()};
      turned.push_back({p.error, p.cost, p.result});
    }
    for (double limit = -0.5; limit < 13.0; limit += 0.5) {
      const auto exact = most_exact_within(points, limit);
      const auto cheap = cheapest_within(turned, limit);
      ASSERT_EQ(exact.has_value(), cheap.has_value());
      if (exact) {
        EXPECT_EQ(exact->result, cheap->result);
      }
    }
  }
}

}  // namespace
}  // namespace substep
