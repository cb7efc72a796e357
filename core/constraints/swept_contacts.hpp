#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/collision/detector.hpp"
#include "core/constraints/block.hpp"

namespace substep {

/// Finds the contacts that close within a sub-step by moving the bodies through it (detection
/// `continuous`): nothing passes through what it hits, and what misses is not touched.
class SweptContacts {
 public:
  /// Reserves memory, so that new contacts do not allocate. @param rows contacts
  void reserve(std::size_t rows);
  /// The motion of the bodies of a part through a sub-step.
  struct Sweep {
    const Scene& scene;
    const Part& part;
    const State& state;          // at its start
    std::span<const Mat3> R_WB;  // at its start
    std::span<const Vec6> w;     // per body: velocities of the motion, 0 if static [m/s, rad/s]
    double dt;                   // [s]
    double until;                // pairs without rows may meet until then, >= dt [s]
  };

  enum class Found : std::uint8_t { kNothing, kOverlaps, kContacts };
  /// Appends a row for each contact that the motion closes, linearised where it closes, with the
  /// gap from which the row, at constant speed, closes at that time. Where rows exist but the
  /// motion overlaps the shapes, because it is curved, Block::curved is updated.
  /// @param first the first block of the part
  /// @return whether rows were appended, or only updated
  Found append(const Sweep& sweep, Detector& detector, std::size_t first, Blocks& blocks);
  /// Until when the last motion kept all shapes apart, from the start of the sub-step [s].
  [[nodiscard]] double earliest() const { return earliest_; }

  /// Rows and pairs looked at, and poses tried, since the last call.
  std::int64_t take_visits() { return std::exchange(visits_, 0); }

  /// An overlap that is left as it is, of the half width of the narrower shape.
  static constexpr double kAllowedOverlap = 1e-4;

 private:
  struct Pair {
    std::uint64_t bodies = 0;  // an id without features
    double floor = 0.0;        // the smallest gap of its rows, at most 0 [m]
    friend bool operator<(const Pair& p, const Pair& q) { return p.bodies < q.bodies; }
  };
  void list_rows(std::span<const Block> rows);
  [[nodiscard]] const Pair* pair_with_rows(int i, int j) const;
  [[nodiscard]] Block* row_of(const Sweep& sweep, const ContactPoint& point, const Mat3& R_a,
                              double half_width, std::span<Block> blocks) const;
  Found correct(const Sweep& sweep, const BroadPhase::Pair& pair, double floor, double half_width,
                std::size_t first, Blocks& blocks);
  Found meet(const Sweep& sweep, const BroadPhase::Pair& pair, double half_width, Blocks& blocks);
  void append_row(const Sweep& sweep, const ContactPoint& point, const Vec3& x_a, const Vec3& x_b,
                  double time, Blocks& blocks) const;

  std::vector<std::pair<std::uint64_t, std::size_t>> rows_;  // id and place, sorted
  std::vector<Pair> pairs_;                                  // sorted
  ContactPoints points_;
  double earliest_ = 0.0;
  std::int64_t visits_ = 0;
};

}  // namespace substep
