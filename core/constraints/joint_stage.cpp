#include "core/constraints/joint_stage.hpp"

#include <cmath>

namespace substep {

JointStage::JointStage(const Scene& scene) : across_(scene.joints.size()) {
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    if (const auto* hinge = std::get_if<HingeJoint>(&scene.joints[i])) {
      across(hinge->axis_b, across_[i].v1, across_[i].v2);
    }
  }
}

void JointStage::begin(const Scene& scene, std::size_t joint, Block& block) {
  const auto moving = [&](int body) {
    return body == kWorld || scene.bodies[static_cast<std::size_t>(body)].is_static ? -1 : body;
  };
  const JointBase& j = base(scene.joints[joint]);
  block.id = joint;
  block.body_a = j.a;
  block.body_b = j.b;
  block.a = moving(j.a);
  block.b = moving(j.b);
  if (const auto* hinge = std::get_if<HingeJoint>(&scene.joints[joint])) {
    block.kind = BlockKind::kHinge;
    block.rows = 5;
    hinge_constants(*hinge, block);
  } else {
    block.kind = BlockKind::kBall;
    block.rows = 3;
    ball_constants(j, block);
  }
}

void JointStage::fill(const Scene& scene, const State& state, std::span<const Mat3> R_WB,
                      std::size_t joint, Block& block) const {
  const auto side = [&](int body) {
    if (body == kWorld) return Side{};
    const auto i = static_cast<std::size_t>(body);
    return Side{state.x[i], R_WB[i]};
  };
  // A block that was this joint's before keeps what does not change.
  if (!block.pinned || block.id != joint) begin(scene, joint, block);
  const Side a = side(block.body_a);
  const Side b = side(block.body_b);
  if (const auto* hinge = std::get_if<HingeJoint>(&scene.joints[joint])) {
    hinge_rows(*hinge, across_[joint].v1, across_[joint].v2, a, b, block);
  } else {
    ball_rows(std::get<BallJoint>(scene.joints[joint]), a, b, block);
  }
}

void JointStage::append(const Scene& scene, const Part& part, const State& state,
                        std::span<const Mat3> R_WB, Blocks& blocks) const {
  for (const int joint : part.joints) {
    fill(scene, state, R_WB, static_cast<std::size_t>(joint), blocks.append());
  }
}

JointErrors JointStage::errors(const Scene& scene, const State& state,
                               std::span<const Mat3> R_WB) const {
  JointErrors errors;
  Block block;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    fill(scene, state, R_WB, i, block);
    for (int row = 0; row < block.rows; ++row) errors.sum += std::abs(block.phi[row]);
    const double gap = std::sqrt(block.phi[0] * block.phi[0] + block.phi[1] * block.phi[1] +
                                 block.phi[2] * block.phi[2]);
    if (gap > errors.gap) {
      errors.gap = gap;
      errors.joint = static_cast<int>(i);
    }
  }
  return errors;
}

}  // namespace substep
