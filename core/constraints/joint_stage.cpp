#include "core/constraints/joint_stage.hpp"

#include <cmath>

namespace substep {

JointStage::JointStage(const Scene& scene) : scene_(scene) {
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    Geometry& geometry = joints_.emplace_back();
    geometry.body_a = j.a;
    geometry.body_b = j.b;
    geometry.anchor_a = j.anchor_a;
    geometry.anchor_b = j.anchor_b;
    const auto* hinge = std::get_if<HingeJoint>(&joint);
    geometry.hinge = hinge != nullptr;
    if (hinge != nullptr) geometry.axes = axes_of(*hinge);
  }
}

void JointStage::begin(std::size_t joint, Block& block) const {
  const auto moving = [&](int body) {
    return body == kWorld || scene_.bodies[index(body)].is_static ? -1 : body;
  };
  const JointBase& j = base(scene_.joints[joint]);
  block.id = joint;
  block.body_a = j.a;
  block.body_b = j.b;
  block.a = moving(j.a);
  block.b = moving(j.b);
  ball_constants(j, block);
  if (const auto* hinge = std::get_if<HingeJoint>(&scene_.joints[joint])) {
    hinge_constants(*hinge, block);
  }
}

void JointStage::fill(const State& state, std::span<const Mat3> R_WB, std::size_t joint,
                      Block& block) const {
  const auto side = [&](int body) {
    return body == kWorld ? Side{} : Side{state.x[index(body)], R_WB[index(body)]};
  };
  // A block that was this joint's before keeps what does not change.
  if (!block.pinned || block.id != joint) begin(joint, block);
  const Geometry& geometry = joints_[joint];
  const Side a = side(geometry.body_a);
  const Side b = side(geometry.body_b);
  ball_rows(geometry.anchor_a, geometry.anchor_b, a, b, block);
  if (geometry.hinge) hinge_rows(geometry.axes, a, b, block);
}

void JointStage::append(const Part& part, const State& state, std::span<const Mat3> R_WB,
                        Blocks& blocks) const {
  for (const int joint : part.joints) fill(state, R_WB, index(joint), blocks.append());
}

JointErrors JointStage::errors(const State& state, std::span<const Mat3> R_WB) const {
  JointErrors errors;
  Block block;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    fill(state, R_WB, i, block);
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
