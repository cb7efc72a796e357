#include "core/stepping/rolling.hpp"

#include "core/constraints/moved_rows.hpp"
#include "core/model/methods.hpp"
#include "core/solver/cost_model.hpp"

namespace substep {

bool aims_rolling(const Settings& settings) {
  return settings.friction_cone == FrictionCone::kCone && !entry_of(settings.solver).at_end;
}

std::int64_t aim_rolling(const Substep& sub) {
  if (!aims_rolling(sub.settings)) return 0;
  std::int64_t flops = 0;
  const auto motion_of = [&](int body) {
    return body < 0 ? Motion{} : motion(sub.u_before[index(body)], sub.dt);
  };
  for (Block& block : sub.rows) {
    if (!block.is_contact() || !sticks(block)) continue;
    double by[2];
    double speed[kMaxRows];
    moved_sliding(block, motion_of(block.a), motion_of(block.b), by);
    row_speeds(block, sub.u_before, speed);
    for (int i = 0; i < 2; ++i) block.bias[1 + i] += by[i] / sub.dt - speed[1 + i];
    flops += move_flops(block, 2);
  }
  return flops;
}

}  // namespace substep
