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
  double sum = 0.0;  // 1-norms of phi over all joints [m, rad]
  double gap = 0.0;  // largest distance between two anchors [m]
  int joint = -1;    // the joint with that gap
};

/// phi and J of the joints of a scene, in file order.
class JointStage {
 public:
  explicit JointStage(const Scene& scene);
  void append(const Part& part, const State& state, std::span<const Mat3> R_WB,
              Blocks& blocks) const;
  [[nodiscard]] JointErrors errors(const State& state, std::span<const Mat3> R_WB) const;

 private:
  /// Packed joint data for a sub-step.
  struct Placed {
    int body_a = 0;
    int body_b = kWorld;
    BlockKind kind = BlockKind::kFirstJoint;
    JointGeometry geometry;
  };
  /// The constant part of a joint's block.
  void begin(std::size_t joint, Block& block) const;
  [[gnu::always_inline]] inline void fill(const State& state, std::span<const Mat3> R_WB,
                                          std::size_t joint, Block& block) const;

  const Scene& scene_;
  std::vector<Placed> joints_;
};

}  // namespace substep
