#pragma once
// The table of joint types: their rows in a block. A type is one struct of static functions in its
// own file, and one entry of JointTable; a missing function is a compile error.

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/constraints/ball_joint.hpp"
#include "core/constraints/cylindrical_joint.hpp"
#include "core/constraints/distance_joint.hpp"
#include "core/constraints/hinge_angle.hpp"
#include "core/constraints/hinge_joint.hpp"
#include "core/constraints/prismatic_joint.hpp"
#include "core/constraints/rope_joint.hpp"
#include "core/constraints/slide_travel.hpp"
#include "core/constraints/stiffness_matrix.hpp"
#include "core/constraints/universal_joint.hpp"
#include "core/constraints/weld_joint.hpp"

namespace substep {

/// Rows that depend on the poses of two bodies. Forces are per row.
template <class Rows>
concept PoseRows = requires(Block& block, const Block& start, const JointGeometry& geometry,
                            const Side& side, const Vec6& velocity, const Motion& motion,
                            RowRange range, double* out, const double* force, Vec6& push,
                            StiffnessMatrix& K) {
  // phi and J at the poses of its sides.
  { Rows::rows(geometry, side, side, block) } -> std::same_as<void>;
  // d2phi/dt2 at constant velocities of a and b [m/s, rad/s].
  { Rows::curvature(start, velocity, velocity, out) } -> std::same_as<void>;
  // Adds d(J^T lambda)/dq to K, or to a class with its functions (turning_stiffness.cpp).
  { Rows::stiffness(start, K) } -> std::same_as<void>;
  // Optional, if K depends on the order of the bodies in directions that the joint does not leave
  // free: mean_stiffness(block, K), the mean of both orders, from which N follows.
  // Change of phi, and J, of some rows after a and b have moved; or the change of phi alone, for
  // all rows.
  { Rows::move(start, motion, motion, range, block) } -> std::same_as<void>;
  { Rows::moved_errors(start, motion, motion, out) } -> std::same_as<void>;
  // Force of the rows on a at r_a [N], and their torque about it [N m].
  { Rows::force(start, force) } -> std::same_as<Vec3>;
  { Rows::torque(start, force) } -> std::same_as<Vec3>;
  // Adds the change of J^T force due to the motion of a and b: force first, then torque.
  { Rows::push_change(start, motion, motion, force, push, push) } -> std::same_as<void>;
};

/// Interface of a joint type J.
template <class Rows, class J>
concept JointRows = PoseRows<Rows> && requires(const J& joint, Block& block) {
  // Constant part of its block: numbers of rows, compliance.
  { Rows::constants(joint, block) } -> std::same_as<void>;
  // The joint's data for rows().
  { Rows::geometry(joint) } -> std::same_as<JointGeometry>;
};

/// In the order of the Joint variant.
using JointTable = std::tuple<BallRows, HingeRows, PrismaticRows, WeldRows, DistanceRows,
                              UniversalRows, CylindricalRows, RopeRows>;

/// Coordinates of joints that limits, motors, drives and dry friction act on, one row each: of
/// joints of the type Owner.
using CoordinateTable = std::tuple<HingeAngle, SlideTravel, CylinderTravel, RopeLength>;

inline constexpr std::size_t kJointKinds = std::variant_size_v<Joint>;
static_assert(std::tuple_size_v<JointTable> == kJointKinds);
static_assert(kJointKinds <= static_cast<std::size_t>(BlockKind::kFirstCoordinate));
static_assert([]<std::size_t... I>(std::index_sequence<I...>) {
  return (JointRows<std::tuple_element_t<I, JointTable>, std::variant_alternative_t<I, Joint>> &&
          ...);
}(std::make_index_sequence<kJointKinds>{}));

/// The block kind of a joint.
inline BlockKind kind_of(const Joint& joint) { return static_cast<BlockKind>(joint.index()); }

inline constexpr std::size_t kCoordinates = std::tuple_size_v<CoordinateTable>;
static_assert([]<std::size_t... I>(std::index_sequence<I...>) {
  return (PoseRows<std::tuple_element_t<I, CoordinateTable>> && ...);
}(std::make_index_sequence<kCoordinates>{}));

/// The block kind of a coordinate of CoordinateTable.
template <class Rows, std::size_t kFirst = 0>
constexpr BlockKind kind_of_coordinate() {
  if constexpr (std::is_same_v<Rows, std::tuple_element_t<kFirst, CoordinateTable>>) {
    return static_cast<BlockKind>(static_cast<std::size_t>(BlockKind::kFirstCoordinate) + kFirst);
  } else {
    return kind_of_coordinate<Rows, kFirst + 1>();
  }
}

/// Calls `visit` with each entry of CoordinateTable.
template <class Visit>
void for_each_coordinate(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit(std::tuple_element_t<I, CoordinateTable>{}), ...);
  }
  (std::make_index_sequence<kCoordinates>{});
}

/// Calls `visit` with the table entry of a joint or a coordinate. @param kind not kContact
template <std::size_t kFirst = 0, class Visit>
[[gnu::always_inline]] inline void with_joint_rows(BlockKind kind, Visit&& visit) {
  if constexpr (kFirst < kJointKinds) {
    if (kind == static_cast<BlockKind>(kFirst)) {
      visit(std::tuple_element_t<kFirst, JointTable>{});
    } else {
      with_joint_rows<kFirst + 1>(kind, visit);
    }
  } else {
    using Rows = std::tuple_element_t<kFirst - kJointKinds, CoordinateTable>;
    if constexpr (kFirst - kJointKinds + 1 == kCoordinates) {
      visit(Rows{});
    } else if (kind == kind_of_coordinate<Rows>()) {
      visit(Rows{});
    } else {
      with_joint_rows<kFirst + 1>(kind, visit);
    }
  }
}

/// The same, also passing the joint.
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
