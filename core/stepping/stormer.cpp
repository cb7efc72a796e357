#include "core/stepping/stormer.hpp"

#include "core/math/flops.hpp"
#include "core/solver/system.hpp"
#include "core/stepping/compliance.hpp"

namespace substep {

namespace {

// In the first sub-steps, and the first after an impact, the change is unknown.
bool changes_are_known(const Vec6& acceleration) { return !acceleration.isZero(0.0); }

}  // namespace

Vec6 stormer_velocity(const Vec6& u, const Vec6& u_before, const Vec6& acceleration,
                      const Vec6& acceleration_change, double dt, double time) {
  const double scaled = changes_are_known(acceleration) ? stormer_growth(dt, time) * dt : 0.0;
  const double per_time = 1.0 / time;
  Vec6 w;
  Vec3 middle;  // angular acceleration
  for (int j = 0; j < 6; ++j) {
    const double a = per_time * (u[j] - u_before[j]);
    const double change = a - acceleration[j];
    w[j] = (u[j] - scaled / 12.0 * acceleration_change[j]) + scaled / 6.0 * change;
    if (j < 3) continue;
    const double growth = scaled / dt;
    middle[j - 3] = a + growth * (7.0 * change - 3.0 * acceleration_change[j]) / 8.0;
  }
  w.tail<3>() += dt * dt / 12.0 * middle.cross(w.tail<3>());
  w.tail<3>() *= half_tangent_factor(0.5 * dt * w.tail<3>());
  return w;
}

void aim_at_stormer_poses(std::span<Block> blocks, std::span<const Vec6> acceleration,
                          std::span<const Vec6> u_guess, std::span<const Motion> motions,
                          std::span<const double> times, double dt) {
  const Motion none;
  const auto motion_of = [&](int body) -> const Motion& {
    return body < 0 ? none : motions[index(body)];
  };
  for (Block& block : blocks) {
    if (block.is_contact()) continue;
    double gained[kMaxRows];
    moved_errors(block, motion_of(block.a), motion_of(block.b), gained);
    double speed[kMaxRows];
    row_speeds(block, u_guess, speed);
    double per_g = 1.0;
    for (const int body : {block.a, block.b}) {
      if (body < 0 || !changes_are_known(acceleration[index(body)])) continue;
      const double time = times[index(body)];
      per_g = 1.0 / (1.0 + stormer_growth(dt, time) * dt / (6.0 * time));
    }
    for (int row = 0; row < block.rows; ++row) {
      if (block.softness[row] >= kGivenForce) continue;
      // The bias of a spring belongs to a mean over the sub-step.
      const double aimed = block.C[row] > 0.0 ? per_g * (block.bias[row] + gained[row] / dt)
                                              : per_g / dt * (block.phi[row] + gained[row]);
      block.bias[row] = aimed - speed[row];
      block.softness[row] *= per_g;
    }
  }
}

std::int64_t stormer_flops(std::span<const Block> blocks, std::size_t bodies) {
  constexpr std::int64_t kBody = 2 * 50 + 60;  // w, w^ and its rotation
  std::int64_t flops = kBody * static_cast<std::int64_t>(bodies);
  for (const Block& block : blocks) {
    if (block.is_contact()) continue;
    const std::int64_t sides = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
    flops += (15 + 4) * block.rows + product_flops(block.rows, 6, sides);
  }
  return flops;
}

}  // namespace substep
