// The elimination order of bodies, and its fill.

#include "core/solver/elimination_order.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/constraints/joint_rows.hpp"

namespace substep::test {
namespace {

Block between(int a, int b, BlockKind kind = kind_of(BallJoint{})) {
  Block block;
  block.kind = kind;
  block.a = a;
  block.b = b;
  block.rows = kind == BlockKind::kContact ? 1 : 3;
  return block;
}

TEST(EliminationOrder, AChainGoesFromItsFreeEndToTheWorldWithoutFill) {
  std::vector<Block> blocks;
  for (int i = 0; i < 30; ++i) blocks.push_back(between(i, i - 1));
  EliminationOrder order;
  EXPECT_TRUE(order.update(blocks, 30));
  EXPECT_FALSE(order.update(blocks, 30));
  ASSERT_EQ(order.order().size(), 30U);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(order.position(i), 29 - i);
    EXPECT_EQ(order.coupled(i).size(), i == 0 ? 0U : 1U);
  }
  blocks.pop_back();
  EXPECT_TRUE(order.update(blocks, 30));
  EXPECT_EQ(order.position(29), -1);
}

// A bridge of pairs of ball joints, with a ball on it that is eliminated first.
TEST(EliminationOrder, AChainBetweenTwoAnchorsGoesFromItsEndsWithoutFill) {
  constexpr int kPlanks = 20;
  constexpr int kBall = kPlanks;
  std::vector<Block> blocks;
  for (int i = 0; i <= kPlanks; ++i) {
    for (int side = 0; side < 2; ++side) blocks.push_back(between(i < kPlanks ? i : -1, i - 1));
  }
  blocks.push_back(between(kBall, kPlanks / 2, BlockKind::kContact));
  EliminationOrder order;
  order.update(blocks, kPlanks + 1);
  EXPECT_EQ(order.position(kBall), 0);
  for (int i = 0; i < kPlanks; ++i) EXPECT_LE(order.coupled(i).size(), 1U) << i;
}

// The anchored end has the rows of two gaps, more than the degrees of freedom of its body.
TEST(EliminationOrder, APlankThatSticksOutGoesFromItsFreeEnd) {
  constexpr int kPlanks = 20;
  std::vector<Block> blocks;
  for (int i = 0; i < kPlanks; ++i) {
    for (int side = 0; side < 2; ++side) blocks.push_back(between(i, i - 1));
  }
  EliminationOrder order;
  order.update(blocks, kPlanks);
  for (int i = 0; i < kPlanks; ++i) EXPECT_EQ(order.position(i), kPlanks - 1 - i);
}

// Layers of four balls and a plate: body 5 k + 4 is the plate of layer k.
TEST(EliminationOrder, BallsGoBeforeThePlatesBetweenThem) {
  constexpr int kLayers = 5;
  std::vector<Block> blocks;
  for (int layer = 0; layer < kLayers; ++layer) {
    const int plate = 5 * layer + 4;
    for (int ball = plate - 4; ball < plate; ++ball) {
      blocks.push_back(between(ball, layer == 0 ? -1 : plate - 5, BlockKind::kContact));
      blocks.push_back(between(ball, plate, BlockKind::kContact));
    }
  }
  EliminationOrder order;
  order.update(blocks, 5 * kLayers);
  for (int body = 0; body < 5 * kLayers; ++body) {
    const int layer = body / 5;
    const bool plate = body % 5 == 4;
    for (const int later : order.coupled(body)) EXPECT_EQ(later % 5, 4) << body << " before a ball";
    EXPECT_LE(order.coupled(body).size(), plate || layer == 0 ? 1U : 2U) << body;
  }
}

TEST(EliminationOrder, DoesNotDependOnTheNumberOfContactPointsOfAPair) {
  std::vector<Block> blocks{between(0, 1), between(1, 2, BlockKind::kContact)};
  EliminationOrder order;
  EXPECT_TRUE(order.update(blocks, 3));
  blocks.push_back(blocks.back());
  EXPECT_FALSE(order.update(blocks, 3));
  blocks.push_back(between(0, 2, BlockKind::kContact));
  EXPECT_TRUE(order.update(blocks, 3));
}

// A grid of n bodies has n log n entries with a good order and n^1.5 with a bad one.
TEST(EliminationOrder, AGridFillsLittle) {
  constexpr int kSide = 40;
  std::vector<Block> blocks;
  for (int i = 0; i < kSide * kSide; ++i) {
    if (i % kSide + 1 < kSide) blocks.push_back(between(i, i + 1, BlockKind::kContact));
    if (i + kSide < kSide * kSide) blocks.push_back(between(i, i + kSide, BlockKind::kContact));
  }
  EliminationOrder order;
  order.update(blocks, kSide * kSide);
  std::size_t coupled = 0;
  for (int i = 0; i < kSide * kSide; ++i) coupled += order.coupled(i).size();
  EXPECT_LT(coupled, 14U * kSide * kSide) << "a band would have " << kSide << " a body";
}

}  // namespace
}  // namespace substep::test
