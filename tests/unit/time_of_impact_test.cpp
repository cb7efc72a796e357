// Times of impact against closed forms, and against sampling of the motion.

#include "core/collision/time_of_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/math/random.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

constexpr double kStep = 0.25;  // [s]

struct Mover {
  Shape shape;
  Vec3 x = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec6 w = Vec6::Zero();
  [[nodiscard]] Travel travel(int body) const { return {body, shape, x, R, w}; }
};

std::optional<double> impact_of(const Mover& a, const Mover& b, double accuracy = 1e-9) {
  ContactPoints scratch;
  std::int64_t steps = 0;
  return time_of_impact(a.travel(0), b.travel(1), kStep, 0.0, accuracy, scratch, steps);
}

TEST(TimeOfImpact, OfTwoSpheresIsTheClosedForm) {
  Mover a{Sphere{0.2}, {-3.0, 0.1, 0.05}};
  Mover b{Sphere{0.3}, {1.0, -0.2, 0.0}};
  a.w << 20.0, 0.0, 0.5, 5.0, 6.0, 7.0;
  b.w << -2.0, 1.0, 0.0, 1.0, 0.0, 0.0;
  const Vec3 x = a.x - b.x;
  const Vec3 v = (a.w - b.w).head<3>();
  const double half = x.dot(v);
  const double root = half * half - v.squaredNorm() * (x.squaredNorm() - 0.25);
  ASSERT_GT(root, 0.0);
  const auto time = impact_of(a, b);
  ASSERT_TRUE(time);
  EXPECT_NEAR(*time, (-half - std::sqrt(root)) / v.squaredNorm(), 1e-9);
}

TEST(TimeOfImpact, IsNothingForWhatMisses) {
  Mover ball{Sphere{0.1}, {-2.0, 1.1 + 1e-6, 0.0}};
  ball.w[0] = 100.0;
  Mover box{Box{{0.05, 1.0, 1.0}}};
  EXPECT_FALSE(impact_of(ball, box));
  ball.x.y() = 1.1 - 1e-6;
  EXPECT_TRUE(impact_of(ball, box));
  ball.w[0] = -100.0;
  EXPECT_FALSE(impact_of(ball, box));
}

/// The least gap within the step by sampling; infinite if boxes stay out of reach. Positive values
/// are those along the best axis.
double least_gap(const Mover& a, const Mover& b, double until) {
  double least = std::numeric_limits<double>::infinity();
  constexpr int kSamples = repetitions(20000, 2000);
  for (int k = 0; k <= kSamples; ++k) {
    const Waypoint p = after(a.travel(0), until * k / kSamples);
    const Waypoint q = after(b.travel(1), until * k / kSamples);
    const auto* box_a = std::get_if<Box>(&a.shape);
    const auto* box_b = std::get_if<Box>(&b.shape);
    least = std::min(least, separating_axis(p.placed(), *box_a, q.placed(), *box_b).gap);
  }
  return least;
}

TEST(TimeOfImpact, OfTumblingBoxesIsThatOfASampledMotion) {
  int hits = 0;
  int misses = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    auto number = [&, k = 0U]() mutable {
      ++k;
      const double s = 43758.5453 * std::sin(12.9898 * seed + 78.233 * k);
      return 2.0 * (s - std::floor(s)) - 1.0;
    };
    Mover a{Box{{0.3, 0.1, 0.2}}, {-2.0, 0.6 * number(), 0.6 * number()}};
    Mover b{Box{{0.1, 0.4, 0.3}}};
    a.w << 12.0, number(), number(), 20.0 * number(), 20.0 * number(), 20.0 * number();
    b.w << number(), number(), number(), 5.0 * number(), 5.0 * number(), 5.0 * number();
    a.R = Quat(number(), number(), number(), number()).normalized().toRotationMatrix();
    b.R = Quat(number(), number(), number(), number()).normalized().toRotationMatrix();
    const auto time = impact_of(a, b, 1e-6);
    if (!time) {
      ++misses;
      EXPECT_GT(least_gap(a, b, kStep), -1e-6);
      continue;
    }
    ++hits;
    EXPECT_GT(least_gap(a, b, *time), 0.0);
    const Waypoint p = after(a.travel(0), *time);
    const Waypoint q = after(b.travel(1), *time);
    EXPECT_LE(
        separating_axis(p.placed(), std::get<Box>(a.shape), q.placed(), std::get<Box>(b.shape)).gap,
        1e-6);
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(misses, 5);
}

// The corner that touches first moves slowly while the others turn fast.
TEST(TimeOfImpact, OfACornerThatApproachesSlowly) {
  const Box shape{{0.3, 0.1, 0.11}};
  const Mover floor{Box{{5.0, 0.5, 5.0}}, {0.0, -0.5, 0.0}};
  int hits = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    substep::Random random(seed);
    const auto number = [&random] { return random.next(); };
    Mover box{shape};
    box.R = Quat{number(), number(), number(), number()}.normalized().toRotationMatrix();
    const Vec3 omega{8.0 * number(), 8.0 * number(), 8.0 * number()};
    Vec3 lowest = Vec3::Zero();
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3 r = box.R * shape.corner(i);
      if (r.y() < lowest.y()) lowest = r;
    }
    const double gap = 4e-4;
    const double slow = 0.05 * (1.0 + number());
    box.x.y() = gap - lowest.y();
    box.w << 0.2, -slow - omega.cross(lowest).y(), 1.4, omega;
    const double until = kStep / 4.0;
    ContactPoints scratch;
    std::int64_t steps = 0;
    const auto time =
        time_of_impact(floor.travel(0), box.travel(1), until, 0.0, 1e-7, scratch, steps);
    EXPECT_LT(steps, 30);
    const double least = least_gap(floor, box, time.value_or(until));
    if (time) {
      ++hits;
      EXPECT_GT(least, 0.0);
      EXPECT_LT(least, 2e-7);
    } else {
      EXPECT_GT(least, 0.0);
    }
  }
  EXPECT_GT(hits, 15);
}

TEST(TimeOfImpact, FindsTheDepthOfAnOverlapOnTheWay) {
  Mover ball{Sphere{0.1}, {0.0, 0.1, 0.0}};
  ball.w[1] = -1.0;
  Mover plane{Plane{}};
  ContactPoints scratch;
  std::int64_t steps = 0;
  const auto time =
      time_of_impact(ball.travel(0), plane.travel(1), kStep, -0.05, 1e-9, scratch, steps);
  ASSERT_TRUE(time);
  EXPECT_NEAR(*time, 0.05, 1e-8);
}

}  // namespace
}  // namespace substep::test
