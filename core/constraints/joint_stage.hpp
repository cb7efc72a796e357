#pragma once

#include <span>
#include <vector>

#include "core/constraints/block.hpp"
#include "core/constraints/hinge_joint.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// Errors of all joints at a state.
struct JointErrors {
  double sum = 0.0;  // 1-norms of phi over all joints [m, rad]
  double gap = 0.0;  // largest distance of two anchors [m]
  int joint = -1;    // whose it is
};

/// phi and J of the joints of a scene, in file order.
class JointStage {
 public:
  explicit JointStage(const Scene& scene);
  void append(const Scene& scene, const Part& part, const State& state, std::span<const Mat3> R_WB,
              Blocks& blocks) const;
  [[nodiscard]] JointErrors errors(const Scene& scene, const State& state,
                                   std::span<const Mat3> R_WB) const;

 private:
  /// What of a joint's block is the same in every sub-step.
  static void begin(const Scene& scene, std::size_t joint, Block& block);
  void fill(const Scene& scene, const State& state, std::span<const Mat3> R_WB, std::size_t joint,
            Block& block) const;

  struct Across {
    Vec3 v1, v2;  // in the frame of b
  };
  std::vector<Across> across_;  // per joint, of hinges
};

}  // namespace substep
