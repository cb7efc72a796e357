#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/math/types.hpp"
#include "core/model/carried.hpp"

namespace substep {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Block::hi of a drive that has all the effort it needs, and of an armature: its row is never at a
/// bound.
inline constexpr double kAnyEffort = std::numeric_limits<double>::max();

/// Bias of a contact that nothing closes [m/s].
inline constexpr double kStaysOpen = 1e30;

/// Block::active_set of a row without a previous sub-step.
inline constexpr std::int8_t kUnknownSet = 2;

/// For joints, the index of their type in the Joint variant; for the coordinate of a joint that is
/// limited or driven, its index in CoordinateTable.
enum class BlockKind : std::uint8_t { kFirstJoint, kFirstCoordinate = 128, kContact = 255 };

/// The rows of one joint, of a limit, motor, drive, dry friction or armature of one, or of one
/// contact point, on at most two moving bodies; array elements beyond `rows` are unspecified. Eq. 3
/// row by row:
///   J u+ + softness * impulse = -bias,   lo <= impulse <= hi.
/// A static body or the world is -1 and has no columns.
struct Block {
  BlockKind kind = BlockKind::kFirstJoint;
  int a = -1;            // moving body, or -1
  int b = -1;            // moving body, or -1
  int rows = 0;          // number used of kMaxRows
  int body_a = -1;       // index into Scene::bodies, moving or not
  int body_b = -1;       // the same, -1 for the world
  std::uint64_t id = 0;  // constant across sub-steps
  // Two points are pinned to each other: rows 0..2 are J_a = [E, -[r_a]], J_b = [-E, [r_b]];
  // further rows have no linear part and J_b = -J_a, whichever side moves. Solvers rely on this,
  // and only J_a of the further rows is stored; see gradient(). All other blocks store J_a and J_b.
  bool has_point_rows = false;
  std::int8_t position_rows = 0;  // number of positional rows, which precede the angular ones
  bool seeded = false;            // the block existed in the last sub-step: impulse is its seed
  // Of a contact or a limit:
  bool was_closed = false;           // carried a force in the last sub-step
  bool awaits = false;               // open, it closes at the end of the sub-step or later
  bool soft = false;                 // a spring
  double restitution = 0.0;          // limit [-]
  std::int8_t active_set[kMaxRows];  // BPP: -1 at lo, 0 free (always for joints), +1 at hi
  // Bounds of the impulse of row 0: 0 and infinity for a contact or a limit, those of its effort
  // for a motor, a drive or dry friction; not read for a joint [N s or N m s].
  double lo = 0.0;
  double hi = kUnbounded;

  // Point rows in a direct solve read only the members up to here, to save memory bandwidth.
  Vec3 r_a = Vec3::Zero();  // arms from the centres of mass to the point of action, world [m]
  Vec3 r_b = Vec3::Zero();
  double phi[kMaxRows] = {};       // constraint error [m or rad]; a positive contact gap is open
  double C[kMaxRows] = {};         // compliance [m/N or rad/(N m)]
  double bias[kMaxRows] = {};      // drift correction [m/s or rad/s]
  double softness[kMaxRows] = {};  // C/dt^2 + regularisation [1/kg or 1/(kg m^2)]
  double impulse[kMaxRows] = {};   // dt lambda: seed in, solution out [N s or N m s]

  double lambda[kMaxRows] = {};  // constraint force of this sub-step, set only if read [N or N m]
  double J_a[kMaxRows][6];       // d phi / d q_a: linear [-], angular [m] (angular rows: [-])
  double J_b[kMaxRows][6];       // d phi / d q_b

  // Contact only: row 0 is the normal, rows 1 and 2 friction with bounds +-mu * impulse[0] * share.
  double mu = 0.0;  // [-]
  // Friction box: 1 each. Cone: |cos|, |sin| of the force's direction, the box with its corner on
  // the circle; the solver rotates it until it opposes the sliding.
  double share[2] = {1.0, 1.0};
  // Isotropic friction, soften_across(): the sliding speed of a contact that slides, times 1 to 2,
  // else 0; and the part of bias[2] that averages its sliding over the sub-step [m/s].
  double sliding = 0.0;
  double across = 0.0;
  Vec3 n = Vec3::Zero();   // from b to a, world; also of a distance joint
  Vec3 t1 = Vec3::Zero();  // tangents, world; set only with friction
  Vec3 t2 = Vec3::Zero();
  // From the centre of b to the touching point of a, gap included [m]. Prismatic: to b's anchor.
  // Distance: from the anchor on b to that on a.
  Vec3 rho = Vec3::Zero();
  Vec3 arm_a = Vec3::Zero();  // from a's centre to the point that rotates with a (0 for a sphere)
  Mat3 H = Mat3::Zero();      // curvature of b's distance field at a's point [1/m]: dn = H dx
  // Joints with an axis, world: axis u fixed in a, and v1, v2 across it fixed in b. If the
  // orientation is fixed or the angle is limited: w across the axis fixed in a.
  Vec3 axis = Vec3::Zero();
  Vec3 v1 = Vec3::Zero();
  Vec3 v2 = Vec3::Zero();
  Vec3 w = Vec3::Zero();

  // Of a coordinate: its armature [kg or kg m^2].
  double armature = 0.0;

  // For compliant rows, compliance.hpp.
  // Elastic part of phi; of a drive its coordinate, full turns included [m or rad]; of an armature
  // the rate of its coordinate before the sub-step [m/s or rad/s].
  double elastic[kMaxRows] = {};
  // Contact or limit: change of the gap in this sub-step beyond dt J u [m or rad].
  double curved = 0.0;
  double spring_ahead[kMaxRows] = {};  // w+, 0 if the row is not a spring
  double given[kMaxRows] = {};         // impulse prescribed before the solve [N s or N m s]
  double spring_rest[kMaxRows] = {};   // part of the mean stretch known before the solve [m or rad]

  // For Newton with forces numerov, from earlier sub-steps.
  double rate[kMaxRows] = {};         // of the force at these poses [N/s or N m/s]
  double rate_change[kMaxRows] = {};  // [N/s^2 or N m/s^2]
  double last[kMaxRows] = {};         // force of the last sub-step [N or N m]
  double last_rate[kMaxRows] = {};    // its rate [N/s or N m/s]
  double last_rate_age = 0.0;         // age of that rate relative to that force [s]

  [[nodiscard]] bool is_contact() const { return kind == BlockKind::kContact; }
  /// Not a joint: its impulses have bounds.
  [[nodiscard]] bool is_bounded() const { return kind >= BlockKind::kFirstCoordinate; }
  /// A contact or a limit: it only pushes, and opens and closes.
  [[nodiscard]] bool is_unilateral() const { return is_bounded() && !(hi < kUnbounded); }
  /// True if the bounds may be reached.
  [[nodiscard]] bool binds() const { return is_bounded() && hi != kAnyEffort; }
  /// The coordinate of a joint as a row: a limit, a motor, a drive, dry friction or an armature.
  [[nodiscard]] bool is_coordinate() const { return is_bounded() && !is_contact(); }
  /// A motor, a drive, dry friction or an armature: it pulls and pushes.
  [[nodiscard]] bool is_motor() const { return is_bounded() && hi < kUnbounded; }
};

/// J of one row on one side, with point rows or without.
inline Vec6 gradient(const Block& block, int row, bool of_a) {
  Vec6 J;
  if (!block.has_point_rows) {
    for (int j = 0; j < 6; ++j) J[j] = (of_a ? block.J_a : block.J_b)[row][j];
    return J;
  }
  const double sign = of_a ? 1.0 : -1.0;
  if (row < 3) {
    const Vec3 r = sign * (of_a ? block.r_a : block.r_b);
    for (int j = 0; j < 3; ++j) J[j] = j == row ? sign : 0.0;
    J[3] = row == 0 ? 0.0 : row == 1 ? -r[2] : r[1];
    J[4] = row == 1 ? 0.0 : row == 2 ? -r[0] : r[2];
    J[5] = row == 2 ? 0.0 : row == 0 ? -r[1] : r[0];
    return J;
  }
  for (int j = 0; j < 6; ++j) J[j] = sign * block.J_a[row][j];
  return J;
}

/// Distance by which the positions of a joint are apart: not the travel of a slide [m].
inline double gap_of(const Block& joint) {
  double square = 0.0;
  for (int row = 0; row < joint.position_rows; ++row) square += joint.phi[row] * joint.phi[row];
  return std::sqrt(square);
}

/// Sets J of a row whose force acts along a direction, at r_a on a and at r_b on b.
[[gnu::always_inline]] inline void set_row(Block& block, int row, const Vec3& along) {
  const Vec3 direction = along;  // a copy: `along` may alias the block
  const Vec3 A = block.r_a.cross(direction);
  const Vec3 B = block.r_b.cross(direction);
  for (int j = 0; j < 3; ++j) {
    block.J_a[row][j] = direction[j];
    block.J_b[row][j] = -direction[j];
    block.J_a[row][3 + j] = A[j];
    block.J_b[row][3 + j] = -B[j];
  }
}

/// The blocks of a sub-step: cleared and refilled without freeing memory.
class Blocks {
 public:
  void reserve(std::size_t n) { storage_.reserve(n); }
  void clear() { size_ = 0; }
  /// Drops all blocks from index n on.
  void keep(std::size_t n) { size_ = n; }
  [[nodiscard]] std::size_t capacity() const { return storage_.capacity(); }
  /// Appends a block. Its contents are those of a dropped block, if any.
  Block& append() {
    if (size_ == storage_.size()) storage_.emplace_back();
    return storage_[size_++];
  }
  [[nodiscard]] std::span<Block> all() { return {storage_.data(), size_}; }
  [[nodiscard]] std::span<const Block> all() const { return {storage_.data(), size_}; }
  [[nodiscard]] std::span<Block> from(std::size_t first) { return all().subspan(first); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::vector<Block> storage_;
  std::size_t size_ = 0;
};

}  // namespace substep
