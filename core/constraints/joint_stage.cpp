#include "core/constraints/joint_stage.hpp"

#include <cmath>
#include <limits>

namespace substep {

JointStage::JointStage(const Scene& scene) : scene_(scene) {
  for (const Joint& joint : scene.joints) {
    Placed& placed = joints_.emplace_back();
    placed.body_a = base(joint).a;
    placed.body_b = base(joint).b;
    placed.kind = kind_of(joint);
    placed.largest_gap = largest_gap(scene, base(joint));
    with_joint_rows(joint, [&](auto rows, const auto& own) {
      Block block;
      rows.constants(own, block);
      placed.has_rows = block.rows > 0;
      placed.geometry = rows.geometry(own);
    });
  }
}

void JointStage::begin(std::size_t joint, Block& block) const {
  const auto moving = [&](int body) {
    return body == kWorld || scene_.bodies[index(body)].is_static ? -1 : body;
  };
  const Placed& placed = joints_[joint];
  block.kind = placed.kind;
  block.id = joint;
  block.body_a = placed.body_a;
  block.body_b = placed.body_b;
  block.a = moving(placed.body_a);
  block.b = moving(placed.body_b);
  with_joint_rows(scene_.joints[joint],
                  [&](auto rows, const auto& own) { rows.constants(own, block); });
}

void JointStage::fill(const State& state, std::span<const Mat3> R_WB, std::size_t joint,
                      Block& block) const {
  const auto side = [&](int body) {
    return body == kWorld ? Side{} : Side{state.x[index(body)], R_WB[index(body)]};
  };
  // A block reused for the same joint keeps its constant part.
  const Placed& placed = joints_[joint];
  if (block.kind != placed.kind || block.id != joint || block.rows == 0) begin(joint, block);
  const Side a = side(placed.body_a);
  const Side b = side(placed.body_b);
  with_joint_rows(placed.kind, [&](auto rows) { rows.rows(placed.geometry, a, b, block); });
}

void JointStage::append(const Part& part, const State& state, std::span<const Mat3> R_WB,
                        Blocks& blocks) const {
  for (const int joint : part.joints) {
    if (joints_[index(joint)].has_rows) fill(state, R_WB, index(joint), blocks.append());
  }
}

void JointStage::set_springs(std::size_t joint, bool positions, bool angles) {
  joints_[joint].spring = positions;
  joints_[joint].turns = angles;
  if (positions && !scene_.criteria.joint_gap) {
    joints_[joint].largest_gap = std::numeric_limits<double>::infinity();
  }
  has_springs_ = has_springs_ || positions || angles;
}

double JointStage::elastic(std::size_t joint, const Block& block) const {
  double energy = 0.0;
  for (int row = 0; row < block.rows; ++row) {
    if (is_spring(joint, row, block))
      energy += 0.5 * block.phi[row] * block.phi[row] / block.C[row];
  }
  return energy;
}

JointErrors JointStage::errors(const State& state, std::span<const Mat3> R_WB) const {
  JointErrors errors;
  Block block;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i].has_rows) continue;
    fill(state, R_WB, i, block);
    for (int row = 0; row < block.rows; ++row) {
      const double error = std::abs(block.phi[row]);
      errors.sum += is_spring(i, row, block) ? 0.0 : error;
    }
    const double gap = gap_of(block);
    if (!joints_[i].spring && gap > errors.gap) {
      errors.gap = gap;
      errors.joint = static_cast<int>(i);
    }
    errors.springs += elastic(i, block);
    const double torn = gap / joints_[i].largest_gap;
    if (torn > errors.torn) {
      errors.torn = torn;
      errors.torn_joint = static_cast<int>(i);
    }
  }
  return errors;
}

}  // namespace substep
