#include "core/stepping/stored_forces.hpp"

#include <algorithm>
#include <bit>

#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/grab_rows.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/time_integrator.hpp"

namespace substep {

namespace {

void seed(const Substep& sub, const State& state, const StoredForce& force, Block& block) {
  const double time = impulse_time_of(sub, block);
  const bool seeds = block.is_bounded() || starts_from_last_forces(sub.settings);
  for (int row = 0; row < block.rows; ++row) {
    block.elastic[row] = force.elastic[row];
    if (seeds) block.impulse[row] = force.lambda[row] * time;
    if (block.is_bounded()) block.active_set[row] = force.active_set[row];
  }
  block.was_closed = force.lambda[0] > 0.0;
  block.seeded = true;
  sub.integrator->seed(force, state, block);
}

}  // namespace

bool forces_are_stored(const Substep& sub) {
  const Effects& effects = sub.scene->effects;
  return effects.contact || acts_on_coordinates(effects) || starts_from_last_forces(sub.settings) ||
         springs_are_stored(sub);
}

std::size_t StoredForceIndex::find(std::span<const StoredForce> forces, std::uint64_t id,
                                   std::size_t from) {
  if (!is_sorted_ || sorted_.size() != forces.size()) {  // an integrator may have appended
    sorted_.clear();
    for (std::size_t i = 0; i < forces.size(); ++i) sorted_.emplace_back(forces[i].id, i);
    std::sort(sorted_.begin(), sorted_.end());
    is_sorted_ = true;
    visits_ += std::ssize(sorted_);
  }
  visits_ += static_cast<std::int64_t>(std::bit_width(sorted_.size()));
  for (const std::size_t least : {from, std::size_t{0}}) {
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(id, least));
    if (found != sorted_.end() && found->first == id) return found->second;
  }
  return forces.size();
}

void seed_forces(const Substep& sub, const State& state, std::span<const StoredForce> of_last,
                 StoredForceIndex& index) {
  std::size_t next = 0;  // blocks are mostly in the order of the last sub-step
  const bool of_joints = starts_from_last_forces(sub.settings) || springs_are_stored(sub);
  for (Block& block : sub.rows.subspan(sub.solved)) {
    for (double& impulse : block.impulse) impulse = 0.0;
    block.seeded = false;
    if (block.is_bounded()) {
      std::fill_n(block.active_set, kMaxRows, kUnknownSet);
      block.was_closed = false;
      block.elastic[0] = 0.0;
    } else if (!of_joints) {
      continue;
    }
    if (of_last.empty()) continue;
    const bool in_order = of_last[next].id == block.id;
    const std::size_t place = in_order ? next : index.find(of_last, block.id, next);
    if (place == of_last.size()) continue;
    seed(sub, state, of_last[place], block);
    next = place + 1 < of_last.size() ? place + 1 : 0;
  }
}

void store_forces(const Substep& sub, const State& state, std::vector<StoredForce>& out) {
  const bool all = starts_from_last_forces(sub.settings);
  const bool soft = drift_law(sub.settings) == Drift::kSoft;
  const bool springs = springs_are_stored(sub);
  for (Block& block : sub.rows) {
    if (!block.is_bounded() && !all && !springs) continue;
    find_lambda(sub, block, block.lambda);
    StoredForce& force = out.emplace_back();
    force.id = block.id;
    for (int row = 0; row < block.rows; ++row) {
      force.lambda[row] = block.lambda[row];
      force.active_set[row] = block.active_set[row];
    }
    sub.integrator->store(sub, state, block, force);
    if (block.is_motor()) {
      force.elastic[0] = is_armature(block) ? rate_after(sub, block) : block.elastic[0];
    }
    if (!soft || is_grab(block)) continue;
    if (block.is_unilateral()) {
      force.elastic[0] = -block.C[0] * block.lambda[0];
    } else if (springs && !block.is_bounded()) {
      store_elastic(block);
      std::copy_n(block.elastic, block.rows, force.elastic);
    }
  }
}

}  // namespace substep
