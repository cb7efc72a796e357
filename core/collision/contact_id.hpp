#pragma once

#include <cstdint>
#include <utility>

namespace substep {

/// Persistent identifier of a contact: the two bodies, each below 2^20, and the touching features,
/// below 2^20. Distinct from the ids of joints and grabs.
inline std::uint64_t contact_id(int a, int b, std::uint64_t feature) {
  return (1ULL << 63U) | (static_cast<std::uint64_t>(a) << 42U) |
         (static_cast<std::uint64_t>(b) << 20U) | feature;
}

inline bool is_contact_id(std::uint64_t id) { return id >> 62U == 2U; }

inline std::pair<int, int> bodies_of_contact(std::uint64_t id) {
  constexpr std::uint64_t kBody = (1U << 20U) - 1U;
  return {static_cast<int>((id >> 42U) & kBody), static_cast<int>((id >> 20U) & kBody)};
}

}  // namespace substep
