// Constraint forces of the last sub-step.

#include "core/sim/constraint_forces.hpp"

#include <algorithm>
#include <array>

#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/grab_rows.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/math/disjoint_sets.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/first_changes.hpp"

namespace substep {
namespace {

/// True if the forces belong to the poses after the sub-step.
bool act_at_end(const Settings& by) {
  if (by.solver == SolverKind::kNewton) return by.forces == Forces::kEnd;
  return entry_of(by.solver).at_end;
}

/// The longer of the last sub-steps of a joint's bodies [s].
double longest_sub_step(const Block& joint, const State& state) {
  double dt = 0.0;
  for (const int body : {joint.a, joint.b}) {
    if (body >= 0) dt = std::max(dt, state.dt_previous_of(index(body)));
  }
  return dt;
}

/// True for each block of bodies that joints alone connect, and whose last sub-step was their
/// first.
std::vector<bool> began_with_joints(const Substep& sub, std::span<const Block> blocks) {
  const std::size_t n = sub.dt_before.size();
  DisjointSets joined;
  joined.reset(n + 1);
  const auto bodies_of = [&](const Block& block, const auto& visit) {
    for (const int body : {block.a, block.b}) {
      if (body >= 0) visit(body);
    }
  };
  for (const Block& block : blocks) {
    if (block.a >= 0 && block.b >= 0) joined.unite(block.a, block.b);
  }
  std::vector<bool> others(n + 1, false);  // per set
  for (const Block& block : blocks) {
    const bool acts = is_grab(block) || block.is_motor() ||
                      (block.is_bounded() && (block.phi[0] <= 0.0 || block.impulse[0] != 0.0));
    bodies_of(block, [&](int body) {
      if (acts || sub.dt_before[index(body)] > 0.0) others[index(joined.root(body))] = true;
    });
  }
  std::vector<bool> began;
  for (const Block& block : blocks) {
    bool joints_alone = !block.is_bounded();
    bodies_of(block,
              [&](int body) { joints_alone = joints_alone && !others[index(joined.root(body))]; });
    began.push_back(joints_alone);
  }
  return began;
}

}  // namespace

// A sub-step that begins at the velocities of the poses does not turn them into the middle of the
// sub-step: its impulses are those of half of its length (leapfrog), or lack what turns the
// velocity (Euler). The forces at these poses follow from the accelerations.
std::vector<std::array<double, kMaxRows>> Simulator::Impl::forces_of_blocks() const {
  std::vector<std::array<double, kMaxRows>> found;
  for (const Block& block : blocks.all()) find_lambda(current, block, found.emplace_back().data());
  if (act_at_end(settings) || entry_of(settings.solver).sweeps) return found;
  const std::vector<bool> began = began_with_joints(current, blocks.all());
  Blocks first;
  for (std::size_t i = 0; i < began.size(); ++i) {
    if (began[i]) first.append() = blocks.all()[i];
  }
  if (first.size() == 0) return found;
  Substep sub = current;
  sub.part = &all;
  sub.rows = first.all();
  sub.limits = {};
  sub.settings.gyroscopic = Gyroscopic::kImplicit;  // all of them are part of the accelerations
  const auto direct = make_solver(SolverKind::kBpp);
  const std::vector<std::array<double, kMaxRows>> lambda =
      accelerations(sub, sub.u_start, *direct).lambda;
  std::size_t next = 0;
  for (std::size_t i = 0; i < began.size(); ++i) {
    if (began[i]) found[i] = lambda[next++];
  }
  return found;
}

ConstraintForces Simulator::constraint_forces() const {
  ConstraintForces out;
  const bool at_end = act_at_end(impl_->settings);
  const std::vector<std::array<double, kMaxRows>> forces = impl_->forces_of_blocks();
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Block& block = impl_->blocks.all()[i];
    const double* lambda = forces[i].data();
    if (block.is_contact()) {
      Vec3 force = lambda[0] * block.n;
      if (block.rows == 3) force += lambda[1] * block.t1 + lambda[2] * block.t2;
      out.contacts.push_back({block.body_a, block.body_b, block.r_a, block.n, force, block.phi[0]});
      continue;
    }
    const std::size_t joint = block.is_bounded() ? index(CoordinateStage::joint_of(block.id))
                                                 : static_cast<std::size_t>(block.id);
    if (joint >= impl_->scene->joints.size()) continue;  // the grab
    out.joints.resize(impl_->scene->joints.size());
    JointForce& force = out.joints[joint];
    force.known = true;
    force.time = impl_->state.time;
    if (!at_end) force.time -= longest_sub_step(block, impl_->state);
    with_joint_rows(block.kind, [&](auto rows) {  // a joint and its coordinate have blocks each
      force.force += rows.force(block, lambda);
      force.torque += rows.torque(block, lambda);
    });
  }
  return out;
}

}  // namespace substep
