#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

inline constexpr int kMaxRows = 5;
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Block::active_set of a row that no earlier sub-step knows.
inline constexpr std::int8_t kUnknownSet = 2;

/// Of a joint the place of its kind among Joint's alternatives.
enum class BlockKind : std::uint8_t { kFirstJoint, kContact = 255 };

/// The rows of one joint or of one contact point, on at most two moving bodies; what its arrays
/// hold beyond its number of rows does not matter. Eq. 3 row by row:
///   J u+ + softness * impulse = -bias,   lo <= impulse <= hi.
/// A static body or the world is -1 and has no columns.
struct Block {
  BlockKind kind = BlockKind::kFirstJoint;
  int a = -1;            // moving body, or -1
  int b = -1;            // moving body, or -1
  int rows = 0;          // used of kMaxRows
  int body_a = -1;       // index into Scene::bodies, moving or not
  int body_b = -1;       // the same, -1 for the world
  std::uint64_t id = 0;  // the same from sub-step to sub-step
  // Two points are tied to each other: rows 0..2 are J_a = [E, -[r_a]], J_b = [-E, [r_b]], further
  // rows have no linear part and J_b = -J_a, whichever side moves. Solvers go by that, and nothing
  // else of J is filled than J_a of the further rows: gradient() knows. Of any other block J_a and
  // J_b are filled.
  bool has_point_rows = false;
  std::int8_t position_rows = 0;     // joint: the first rows are of positions, the others of angles
  bool seeded = false;               // the last sub-step had this block: impulse is of it
  bool was_closed = false;           // contact: carried a force in the last sub-step
  std::int8_t active_set[kMaxRows];  // of BPP: -1 at lo, 0 free as all of joints, +1 at hi

  // A pin in a direct solve reads no further than these: of a long chain that is less memory.
  Vec3 r_a = Vec3::Zero();  // arms from the centres of mass to the point of action, world [m]
  Vec3 r_b = Vec3::Zero();
  double phi[kMaxRows] = {};       // constraint error [m or rad]; a positive contact gap is open
  double C[kMaxRows] = {};         // compliance [m/N or rad/(N m)]
  double bias[kMaxRows] = {};      // drift correction [m/s or rad/s]
  double softness[kMaxRows] = {};  // C/dt^2 + regularisation [1/kg or 1/(kg m^2)]
  double impulse[kMaxRows] = {};   // dt lambda: seed in, solution out [N s or N m s]

  double lambda[kMaxRows] = {};  // constraint force of this sub-step, where it is read [N or N m]
  double J_a[kMaxRows][6];       // d phi / d q_a: linear [-], angular [m] (angular rows: [-])
  double J_b[kMaxRows][6];       // d phi / d q_b

  // Contact only: row 0 is the normal, rows 1 and 2 friction with bounds +-mu * impulse[0] * share.
  double mu = 0.0;  // [-]
  // Of the box of friction 1 each. Of the cone |cos|, |sin| of the force's direction: the box whose
  // corner lies on the circle there, which the solver turns until it is against the sliding.
  double share[2] = {1.0, 1.0};
  Vec3 n = Vec3::Zero();   // from b to a, world
  Vec3 t1 = Vec3::Zero();  // tangents, world; filled where there is friction
  Vec3 t2 = Vec3::Zero();
  Vec3 rho = Vec3::Zero();    // from the centre of b to the touching point of a, gap included [m]
  Vec3 arm_a = Vec3::Zero();  // of a's point that follows a's rotation (0 for a sphere)
  Mat3 H = Mat3::Zero();      // curvature of b's distance field at a's point [1/m]: dn = H dx
  // Joints with an axis, world: axis u fixed in a, and v1, v2 across it fixed in b. Prismatic: w
  // across the axis fixed in a.
  Vec3 axis = Vec3::Zero();
  Vec3 v1 = Vec3::Zero();
  Vec3 v2 = Vec3::Zero();
  Vec3 w = Vec3::Zero();

  // Of compliant rows, compliance.hpp.
  double elastic[kMaxRows] = {};       // of phi, what is the spring's own [m or rad]
  double spring_ahead[kMaxRows] = {};  // w+, 0 where the row is no spring
  double given[kMaxRows] = {};         // impulse that is known before the solve [N s or N m s]
  double spring_rest[kMaxRows] = {};   // what of its mean is known before the solve [m or rad]

  // What Newton with forces numerov needs of the sub-steps before.
  double rate[kMaxRows] = {};         // of the force at these poses [N/s or N m/s]
  double rate_change[kMaxRows] = {};  // [N/s^2 or N m/s^2]
  double last[kMaxRows] = {};         // the force of the last one [N or N m]
  double last_rate[kMaxRows] = {};    // its rate [N/s or N m/s]
  double last_rate_age = 0.0;         // how long before that force the rate was so [s]

  [[nodiscard]] bool is_contact() const { return kind == BlockKind::kContact; }
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

/// The blocks of a sub-step: cleared and refilled without giving memory back.
class Blocks {
 public:
  void reserve(std::size_t n) { storage_.reserve(n); }
  void clear() { size_ = 0; }
  /// Lets go of all from the n-th on.
  void keep(std::size_t n) { size_ = n; }
  [[nodiscard]] std::size_t capacity() const { return storage_.capacity(); }
  /// A block at the end, with what it held before it was let go of.
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
