#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/constraints/swept_contacts.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Limits, motors, drives, springs, dry friction and armatures of joints: one row for each that
/// acts, on a coordinate of CoordinateTable.
class CoordinateStage {
 public:
  /// The parts of a joint that have rows of their own.
  enum class Acts : std::uint8_t { kLower, kUpper, kMotor, kDrive, kFriction, kArmature, kSpring };

  /// Those whose effect is enabled.
  explicit CoordinateStage(const Scene& scene);
  /// Largest number of rows.
  [[nodiscard]] std::size_t size() const { return placed_.size(); }
  [[nodiscard]] bool has_limits() const { return has_limits_; }

  /// Appends friction, armatures, motors, drives and springs, whose phi is the coordinate, and
  /// limits that are closed or may close.
  /// @param dt the sub-step [s]  @param touching only limits that are closed: sweep() finds others
  void append(const Part& part, const State& state, std::span<const Mat3> R_WB, double dt,
              bool touching, Blocks& blocks);
  /// Appends the limits that a motion closes, and corrects rows for its curvature:
  /// SweptContacts::append().
  SweptContacts::Found sweep(const SweptContacts::Sweep& sweep, std::size_t first, Blocks& blocks);
  /// As SweptContacts::earliest().
  [[nodiscard]] double earliest() const { return earliest_; }

  /// The motor, the drive or the largest friction [N m or N] of a row. A spring is a drive without
  /// bounds towards its rest.
  [[nodiscard]] const Motor& motor(const Block& row) const;
  [[nodiscard]] Drive drive(const Block& row) const;
  [[nodiscard]] double friction(const Block& row) const;
  /// In place of the half width of a shape: the measure of the tolerances of a limit [rad or m].
  [[nodiscard]] double width_of(const Block& row) const;

  /// Energy of the springs: the sum of k (x - rest)^2/2 [J].
  [[nodiscard]] double elastic(const State& state, std::span<const Mat3> R_WB) const;

  /// Whether a block's id is one of these rows, which part of its joint it is, and the joint.
  [[nodiscard]] static bool is_id(std::uint64_t id) { return id >> 62U == 1U; }
  [[nodiscard]] static std::uint64_t id_of(std::size_t joint, Acts part);
  [[nodiscard]] static Acts acts(std::uint64_t id);
  [[nodiscard]] static int joint_of(std::uint64_t id);

 private:
  struct Placed {
    std::uint64_t id = 0;
    int joint = 0;
    Acts acts = Acts::kLower;
    [[nodiscard]] bool is_limit() const { return acts <= Acts::kUpper; }
    BlockKind kind = BlockKind::kFirstCoordinate;
    JointGeometry geometry;
    double width = 0.0;     // as width_of()
    double armature = 0.0;  // of the joint, if the effect is enabled
    std::size_t row = 0;    // the last block
  };
  Block& place(const Placed& placed, const State& state, std::span<const Mat3> R_WB,
               Block& block) const;
  template <class Visit>
  void for_each(const Part& part, Visit&& visit);

  const Scene& scene_;
  std::vector<Placed> placed_;
  std::vector<std::size_t> first_;  // per joint: its first one; one more at the end
  Block scratch_;
  bool has_limits_ = false;
  bool has_springs_ = false;
  double earliest_ = 0.0;
};

/// The coordinate of a drive's or a spring's row [rad or m], from that of the last sub-step in
/// Block::elastic if it is known: an angle is continuous, and counts full turns.
double coordinate_of(const Block& row);

/// True for the row of a spring.
inline bool is_joint_spring(const Block& row) {
  return row.is_coordinate() && CoordinateStage::acts(row.id) == CoordinateStage::Acts::kSpring;
}
/// True for the row of a drive or a spring.
inline bool is_drive(const Block& row) {
  return is_joint_spring(row) ||
         (row.is_coordinate() && CoordinateStage::acts(row.id) == CoordinateStage::Acts::kDrive);
}
/// True for the row of an armature.
inline bool is_armature(const Block& row) {
  return row.is_coordinate() && CoordinateStage::acts(row.id) == CoordinateStage::Acts::kArmature;
}
/// True for a row of dry friction.
inline bool is_joint_friction(const Block& row) {
  return row.is_coordinate() && CoordinateStage::acts(row.id) == CoordinateStage::Acts::kFriction;
}

}  // namespace substep
