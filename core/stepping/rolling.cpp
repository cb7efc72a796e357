#include "core/stepping/rolling.hpp"

#include <algorithm>

#include "core/model/methods.hpp"
#include "core/solver/cost_model.hpp"

namespace substep {

bool aims_rolling(const Settings& settings) {
  return settings.friction_cone == FrictionCone::kCone && !entry_of(settings.solver).at_end;
}

std::int64_t aim_rolling(const Substep& sub, Motions& motions) {
  const auto rolls = [](const Block& block) { return block.is_contact() && sticks(block); };
  if (!aims_rolling(sub.settings) || std::none_of(sub.rows.begin(), sub.rows.end(), rolls)) {
    return 0;
  }
  for (const int body : sub.part->moving) {
    motions[index(body)] = motion(sub.u_before[index(body)], sub.dt);
  }
  std::int64_t flops = 0;
  for (Block& block : sub.rows) {
    if (!rolls(block)) continue;
    double by[2];
    double speed[kMaxRows];
    moved_sliding(block, motions.of(block.a), motions.of(block.b), by);
    row_speeds(block, sub.u_before, speed);
    for (int i = 0; i < 2; ++i) block.bias[1 + i] += by[i] / sub.dt - speed[1 + i];
    flops += move_flops(block, 2);
  }
  return flops;
}

}  // namespace substep
