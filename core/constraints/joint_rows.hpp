#pragma once
// The table of joints: what each kind of Joint does as rows of a block. A kind is one struct of
// static functions in a file of its own, and one entry of JointTable; a kind that leaves a function
// out does not compile.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/constraints/ball_joint.hpp"
#include "core/constraints/hinge_joint.hpp"
#include "core/constraints/prismatic_joint.hpp"

namespace substep {

/// What a kind of joint J gives. Forces are those of its rows, one per row.
template <class Rows, class J>
concept JointRows = requires(const J& joint, Block& block, const Block& start,
                             const JointGeometry& geometry, const Side& side, const Vec6& velocity,
                             const Motion& motion, RowRange range, double* out, const double* force,
                             Vec6& push, StiffnessMatrix& K, std::span<Mat3> turning,
                             std::int64_t bodies) {
  // What of its block is the same in every sub-step: numbers of rows, compliance.
  { Rows::constants(joint, block) } -> std::same_as<void>;
  // What rows() reads of the joint.
  { Rows::geometry(joint) } -> std::same_as<JointGeometry>;
  // phi and J at the poses of its sides.
  { Rows::rows(geometry, side, side, block) } -> std::same_as<void>;
  // d2phi/dt2 at constant velocities of a and b [m/s, rad/s].
  { Rows::curvature(start, velocity, velocity, out) } -> std::same_as<void>;
  // Adds d(J^T lambda)/dq to K, and what of it a body's own rotation does to its own torque.
  { Rows::stiffness(start, K) } -> std::same_as<void>;
  { Rows::turning_stiffness(start, turning) } -> std::same_as<void>;
  // phi, less that before, and J of some rows after a and b have moved; or phi of all alone.
  { Rows::move(start, motion, motion, range, block) } -> std::same_as<void>;
  { Rows::moved_errors(start, motion, motion, out) } -> std::same_as<void>;
  // What forces of the rows exert on a: a force at r_a [N], and a couple about it [N m].
  { Rows::force(start, force) } -> std::same_as<Vec3>;
  { Rows::torque(start, force) } -> std::same_as<Vec3>;
  // Adds the change of J^T force as a and b move, on each: force first, then torque.
  { Rows::push_change(start, motion, motion, force, push, push) } -> std::same_as<void>;
  // Floating-point operations of the two, with so many bodies that move.
  { Rows::stiffness_flops(bodies) } -> std::same_as<std::int64_t>;
  { Rows::turning_stiffness_flops(bodies) } -> std::same_as<std::int64_t>;
};

/// In the order of Joint's alternatives.
using JointTable = std::tuple<BallRows, HingeRows, PrismaticRows>;

inline constexpr std::size_t kJointKinds = std::variant_size_v<Joint>;
static_assert(std::tuple_size_v<JointTable> == kJointKinds);
static_assert(kJointKinds < static_cast<std::size_t>(BlockKind::kContact));
static_assert([]<std::size_t... I>(std::index_sequence<I...>) {
  return (JointRows<std::tuple_element_t<I, JointTable>, std::variant_alternative_t<I, Joint>> &&
          ...);
}(std::make_index_sequence<kJointKinds>{}));

/// The kind of a joint's block.
inline BlockKind kind_of(const Joint& joint) { return static_cast<BlockKind>(joint.index()); }
template <class J>
constexpr BlockKind kind_of() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    std::size_t kind = 0;
    ((std::is_same_v<std::variant_alternative_t<I, Joint>, J> ? (void)(kind = I) : (void)0), ...);
    return static_cast<BlockKind>(kind);
  }
  (std::make_index_sequence<kJointKinds>{});
}

/// Calls `visit` with the entry of a joint's kind. @param kind not kContact
template <std::size_t kFirst = 0, class Visit>
[[gnu::always_inline]] inline void with_joint_rows(BlockKind kind, Visit&& visit) {
  using Rows = std::tuple_element_t<kFirst, JointTable>;
  if constexpr (kFirst + 1 == kJointKinds) {
    visit(Rows{});
  } else if (kind == static_cast<BlockKind>(kFirst)) {
    visit(Rows{});
  } else {
    with_joint_rows<kFirst + 1>(kind, visit);
  }
}

/// The same with the joint itself beside its entry.
template <class Visit>
void with_joint_rows(const Joint& joint, Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((joint.index() == I
                ? (visit(std::tuple_element_t<I, JointTable>{}, std::get<I>(joint)), true)
                : false) ||
           ...);
  }
  (std::make_index_sequence<kJointKinds>{});
}

}  // namespace substep
