#pragma once

#include <cstdint>
#include <utility>

#include "core/math/types.hpp"

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

inline std::uint64_t feature_of_contact(std::uint64_t id) { return id & ((1U << 20U) - 1U); }

/// One point where body a nearly touches body b. phi is the distance from a's point to b's surface.
struct ContactPoint {
  int a = 0;                    // index into Scene::bodies
  int b = 0;                    // index into Scene::bodies
  std::uint64_t id = 0;         // pair and features: persistent across sub-steps
  Vec3 n = Vec3::UnitY();       // unit, from b to a, world
  double gap = 0.0;             // < 0 when overlapping [m]
  Vec3 point_a = Vec3::Zero();  // on the surface of a, from a's centre, world axes [m]
  Vec3 point_b = Vec3::Zero();  // on the surface of b, from b's centre, world axes [m]
  // The gap is D(p) - radius, D the distance field fixed in b and p a point fixed in a: for a
  // sphere its centre (field_arm = 0), for a corner the corner (field_arm = point_a).
  Vec3 field_arm = Vec3::Zero();  // p from a's centre, world axes [m]
  Mat3 H = Mat3::Zero();          // second derivative of D at p, world axes [1/m]
};

}  // namespace substep
