#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/stepping/substep.hpp"

namespace substep {

// Forces of the last sub-step: they initialise contacts and warm starts, and keep the elastic part
// of springs.

/// True if forces of any constraint are stored.
bool forces_are_stored(const Substep& sub);

/// Finds stored forces by the id of their block, in logarithmic time. The list is sorted on the
/// first search after clear().
class StoredForceIndex {
 public:
  void reserve(std::size_t forces) { sorted_.reserve(forces); }
  /// To be called when the list has changed.
  void clear() { is_sorted_ = false; }
  /// The first force with an id from place `from` on, or before it.
  /// @return its place, or the size of the list
  std::size_t find(std::span<const StoredForce> forces, std::uint64_t id, std::size_t from);

  /// Forces looked at since the last call.
  std::int64_t take_visits() { return std::exchange(visits_, 0); }

 private:
  std::vector<std::pair<std::uint64_t, std::size_t>> sorted_;  // id and place
  bool is_sorted_ = false;
  std::int64_t visits_ = 0;
};

/// Sets the seed of each block that this sub-step has not solved yet to the force that was stored
/// for it. @param index of `of_last`
void seed_forces(const Substep& sub, const State& state, std::span<const StoredForce> of_last,
                 StoredForceIndex& index);

/// Appends the forces of the sub-step.
void store_forces(const Substep& sub, const State& state, std::vector<StoredForce>& out);

}  // namespace substep
