#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Errors of all joints at a state.
struct JointErrors {
  double sum = 0.0;      // 1-norm of phi over all rows that are no springs [m, rad]
  double gap = 0.0;      // largest gap of a joint that is no spring [m]
  int joint = -1;        // the joint with that gap
  double torn = 0.0;     // largest gap of a joint that is no spring, of largest_gap() [-]
  int torn_joint = -1;   // that joint
  double springs = 0.0;  // energy of the joints that are springs [J]
};

/// phi and J of the joints of a scene, in file order.
class JointStage {
 public:
  explicit JointStage(const Scene& scene);
  void append(const Part& part, const State& state, std::span<const Mat3> R_WB,
              Blocks& blocks) const;
  [[nodiscard]] JointErrors errors(const State& state, std::span<const Mat3> R_WB) const;

  /// Rows of a joint that are springs, for the elastic energy: holding_rows() in sim/.
  void set_springs(std::size_t joint, bool positions, bool angles);
  [[nodiscard]] bool has_springs() const { return has_springs_; }
  [[nodiscard]] bool is_spring(std::size_t joint, int row, const Block& block) const {
    return row < block.position_rows ? joints_[joint].spring : joints_[joint].turns;
  }

 private:
  /// Packed joint data for a sub-step.
  struct Placed {
    int body_a = 0;
    int body_b = kWorld;
    BlockKind kind = BlockKind::kFirstJoint;
    JointGeometry geometry;
    bool has_rows = true;      // not a rope
    bool spring = false;       // in its position rows
    bool turns = false;        // a spring in its angular rows
    double largest_gap = 0.0;  // at which it is torn [m]
  };
  /// phi^2 / 2C of the rows that are springs [J].
  [[nodiscard]] double elastic(std::size_t joint, const Block& block) const;
  /// The constant part of a joint's block.
  void begin(std::size_t joint, Block& block) const;
  [[gnu::always_inline]] inline void fill(const State& state, std::span<const Mat3> R_WB,
                                          std::size_t joint, Block& block) const;

  const Scene& scene_;
  std::vector<Placed> joints_;
  bool has_springs_ = false;
};

}  // namespace substep
