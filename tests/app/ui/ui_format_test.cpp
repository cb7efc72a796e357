#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/text/format.hpp"

namespace substep {
namespace {

TEST(Format, ShortNumbersHaveThreeDigits) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.852), "0.852");
  EXPECT_EQ(short_number(12.34), "12.3");
  EXPECT_EQ(short_number(7954.0), "7,954");
  EXPECT_EQ(short_number(552000.0), "5.52×10⁵");
  EXPECT_EQ(short_number(-4.39e-6), "−4.39×10⁻⁶");
  EXPECT_EQ(short_number(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(short_number(std::nan("")), "not a number");
}

TEST(Format, CoarseNumbersHaveTwoDigits) {
  EXPECT_EQ(coarse_number(2.32e-4), "2.3×10⁻⁴");
  EXPECT_EQ(coarse_number(0.00784), "0.0078");
  EXPECT_EQ(coarse_number(65.5), "66");
}

TEST(Format, PlainNumbersEndInNoZeros) {
  EXPECT_EQ(plain_number(0.1), "0.1");
  EXPECT_EQ(plain_number(0.025), "0.025");
  EXPECT_EQ(plain_number(1.0), "1");
  EXPECT_EQ(plain_number(2e5), "2×10⁵");
  EXPECT_EQ(plain_number(1.25e-7), "1.25×10⁻⁷");
}

TEST(Format, ThousandsAreGrouped) {
  EXPECT_EQ(grouped(1000.0), "1,000");
  EXPECT_EQ(grouped(20000.0), "20,000");
  EXPECT_EQ(grouped(-1234567.0), "−1,234,567");
  EXPECT_EQ(grouped(12.0), "12");
}

TEST(Format, NoMinusZero) {
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(fixed(-0.01, 2), "−0.01");
}

TEST(Format, UnitKeepsTheScaleBelowAThousand) {
  EXPECT_EQ(unit_for(51500.0).prefix, "k");
  EXPECT_EQ(unit_for(1000.0).prefix, "k");
  EXPECT_EQ(unit_for(999.0).prefix, "");
  EXPECT_EQ(unit_for(0.02).prefix, "m");
  EXPECT_EQ(unit_for(5.0).prefix, "");
  EXPECT_EQ(unit_for(0.0).prefix, "");
  EXPECT_EQ(unit_for(2e-9).prefix, "n");
  EXPECT_EQ(unit_for(4.3e-13).prefix, "f");
  EXPECT_EQ(unit_for(2e-17).prefix, "10⁻¹⁸ ");
  EXPECT_EQ(unit_for(2e14).prefix, "T");
  EXPECT_EQ(unit_for(2e28).prefix, "10²⁷ ");
  EXPECT_EQ(unit_for(2e28).factor, 1e27);
}

TEST(Format, DurationPicksItsUnit) {
  EXPECT_EQ(duration(844e-6), "844 µs");
  EXPECT_EQ(duration(1.5e-3), "1.50 ms");
}

}  // namespace
}  // namespace substep
