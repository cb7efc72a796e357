// Stored forces are found by the id of their block.

#include "core/stepping/stored_forces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace substep::test {
namespace {

std::size_t one_by_one(const std::vector<StoredForce>& forces, std::uint64_t id, std::size_t from) {
  for (std::size_t tried = 0; tried < forces.size(); ++tried) {
    const std::size_t place = (from + tried) % forces.size();
    if (forces[place].id == id) return place;
  }
  return forces.size();
}

// Ids may occur twice, in a scene file for example: the next one from the last place on counts.
TEST(StoredForceIndex, FindsWhatASearchOneByOneFinds) {
  std::mt19937_64 random(3);
  StoredForceIndex index;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<StoredForce> forces(1 + random() % 60);
    for (StoredForce& force : forces) force.id = random() % 40;
    index.clear();
    for (std::size_t from = 0; from < forces.size(); ++from) {
      for (std::uint64_t id = 0; id < 40; ++id) {
        ASSERT_EQ(index.find(forces, id, from), one_by_one(forces, id, from));
      }
    }
  }
}

TEST(StoredForceIndex, NoticesThatTheListHasGrown) {
  StoredForceIndex index;
  std::vector<StoredForce> forces(2);
  forces[1].id = 7;
  EXPECT_EQ(index.find(forces, 9, 0), 2U);
  forces.emplace_back().id = 9;
  EXPECT_EQ(index.find(forces, 9, 0), 2U);
  EXPECT_EQ(index.find({}, 9, 0), 0U);
}

}  // namespace
}  // namespace substep::test
