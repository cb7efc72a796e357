#include "core/sim/joint_starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constraints/joint_stage.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {
namespace {

constexpr double kRelative = 1e-9;  // of lengths, angles and velocities [-]
constexpr double kRoundingOfAnchors = 4.0 * std::numeric_limits<double>::epsilon();  // [-]

/// Mean of J M^-1 J^T over some rows of a block [1/kg or 1/(kg m^2)].
double mean_inverse_mass(const Block& block, int first, int last,
                         std::span<const InverseMass> inverse_mass) {
  double sum = 0.0;
  for (int row = first; row < last; ++row) {
    for (const bool of_a : {true, false}) sum += mobility_on(block, row, of_a, inverse_mass);
  }
  return sum / (last - first);
}

/// 2-norm of some rows.
double norm(const double* rows, int first, int last) {
  double square = 0.0;
  for (int row = first; row < last; ++row) square += rows[row] * rows[row];
  return std::sqrt(square);
}

/// Position and speeds of the bodies of a joint.
struct SideSizes {
  double distance = 0.0;  // of the centres from the origin [m]
  double speed = 0.0;     // of the centres and of the anchors about them [m/s]
  double turning = 0.0;   // [rad/s]
};

SideSizes sizes(const JointBase& joint, const State& state) {
  SideSizes sum;
  const auto add = [&](int body, const Vec3& arm) {
    if (body == kWorld) {
      sum.distance += arm.norm();
      return;
    }
    const Vec6& u = state.u[index(body)];
    const double omega = u.tail<3>().norm();
    sum.distance += state.x[index(body)].norm();
    sum.speed += u.head<3>().norm() + omega * arm.norm();
    sum.turning += omega;
  };
  add(joint.a, joint.anchor_a);
  add(joint.b, joint.anchor_b);
  return sum;
}

JointStart measured(const Scene& scene, const State& state, const Block& block,
                    const HoldingRows& holds) {
  const JointBase& joint = base(scene.joints[static_cast<std::size_t>(block.id)]);
  const SideSizes size = sizes(joint, state);
  double speeds[kMaxRows];
  row_speeds(block, state.u, speeds);
  JointStart start;
  double sine = 0.0;  // of the tilt
  const int positions = block.position_rows;
  if (holds.anchors) {
    start.gap = gap_of(block);
    start.speed = norm(speeds, 0, positions);
  }
  if (holds.axes && block.rows > positions) {
    sine = norm(block.phi, positions, block.rows);
    start.tilt = std::asin(std::min(1.0, sine));
    start.turning = norm(speeds, positions, block.rows);
  }
  const double length =
      kRelative * size_of_joint(scene, joint) + kRoundingOfAnchors * size.distance;
  start.beyond.gap = !(start.gap <= length);
  start.beyond.tilt = !(sine <= kRelative);
  // At a lower speed a joint opens by less than kRelative of its size in a frame.
  const double speed = size_of_joint(scene, joint) / scene.frame + size.speed;
  const double turning = 1.0 / scene.frame + size.turning;
  start.beyond.speed = !(start.speed <= kRelative * speed);
  start.beyond.turning = !(start.turning <= kRelative * turning);
  return start;
}

void keep_larger(double& most, int& whose, double value, std::size_t joint) {
  if (!(value > most)) return;
  most = value;
  whose = static_cast<int>(joint);
}

}  // namespace

HoldingRows holding_rows(const Block& block, std::span<const InverseMass> inverse_mass, double h) {
  const auto yields = [&](int first, int last) {
    return block.C[first] > 0.0 &&
           block.C[first] >= h * h * mean_inverse_mass(block, first, last, inverse_mass);
  };
  const int positions = block.position_rows;
  return {!yields(0, positions), block.rows > positions && !yields(positions, block.rows)};
}

namespace {

/// Calls `visit(block, holding rows)` for every joint.
void for_each_joint(const Scene& scene, const State& state, const JointStage& joints,
                    const auto& visit) {
  std::vector<Mat3> R_WB;
  for (const Quat& q : state.q) R_WB.push_back(q.toRotationMatrix());
  Blocks blocks;
  joints.append(whole(scene), state, R_WB, blocks);
  std::vector<InverseMass> inverse(scene.bodies.size());
  inverse_mass(inertia_inverses(scene), whole(scene), R_WB, inverse);
  for (const Block& block : blocks.all()) {
    visit(block, holding_rows(block, inverse, scene.frame));
  }
}

}  // namespace

std::vector<JointStart> joint_starts(const Scene& scene, const State& state) {
  std::vector<JointStart> starts;
  if (!scene.effects.joints || !is_runnable(scene) || !fits(state, scene)) return starts;
  starts.resize(scene.joints.size());  // a rope has no rows and is closed
  for_each_joint(scene, state, JointStage(scene), [&](const Block& block, HoldingRows holds) {
    starts[static_cast<std::size_t>(block.id)] = measured(scene, state, block, holds);
  });
  return starts;
}

void mark_springs(const Scene& scene, const State& state, JointStage& joints) {
  const auto yields = [](const Joint& joint) {
    return base(joint).compliance > 0.0 || angular_compliance_of(joint).value_or(0.0) > 0.0;
  };
  if (std::none_of(scene.joints.begin(), scene.joints.end(), yields)) return;
  for_each_joint(scene, state, joints, [&](const Block& block, HoldingRows holds) {
    joints.set_springs(static_cast<std::size_t>(block.id), !holds.anchors,
                       block.rows > block.position_rows && !holds.axes);
  });
}

StartErrors start_errors(const Scene& scene, const State& state) {
  StartErrors errors;
  const std::vector<JointStart> starts = joint_starts(scene, state);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    keep_larger(errors.gap, errors.gap_joint, starts[i].gap, i);
    keep_larger(errors.tilt, errors.tilt_joint, starts[i].tilt, i);
    keep_larger(errors.speed, errors.speed_joint, starts[i].speed, i);
    keep_larger(errors.turning, errors.turning_joint, starts[i].turning, i);
    for (bool StartFaults::*fault :
         {&StartFaults::gap, &StartFaults::tilt, &StartFaults::speed, &StartFaults::turning}) {
      errors.beyond.*fault = errors.beyond.*fault || starts[i].beyond.*fault;
    }
  }
  return errors;
}

}  // namespace substep
