#include "core/constraints/restitution_stage.hpp"

#include <algorithm>
#include <iterator>

namespace substep {
namespace {

// Bias of an open contact: no impact can close it [m/s].
constexpr double kOpen = 1e30;

/// Speed along the normal, positive when the bodies separate [m/s].
double normal_speed(const Block& block, std::span<const Vec6> u) {
  double speed = 0.0;
  for (int j = 0; j < 6; ++j) {
    if (block.a >= 0) speed += block.J_a[0][j] * u[index(block.a)][j];
    if (block.b >= 0) speed += block.J_b[0][j] * u[index(block.b)][j];
  }
  return speed;
}

}  // namespace

double RestitutionStage::restitution_of(const Block& contact) const {
  return std::max(scene_.bodies[index(contact.body_a)].restitution,
                  scene_.bodies[index(contact.body_b)].restitution);
}

double RestitutionStage::impact_speed(std::span<const Vec6> u, double dt,
                                      const Block& block) const {
  if (!block.is_contact() || restitution_of(block) == 0.0) return 0.0;
  const double approach = normal_speed(block, u);
  const bool closes = block.phi[0] + approach * dt < 0.0;
  return closes && approach <= -scene_.contact.restitution_speed ? -approach : 0.0;
}

void RestitutionStage::apply(std::span<const Vec6> u_before, double dt,
                             std::span<Block> blocks) const {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Block& block = blocks[i];
    const double speed = impact_speed(u_before, dt, block);
    if (speed > 0.0) block.bias[0] = std::min(block.bias[0], -restitution_of(block) * speed);
    if (struck_.empty() || struck_[i] == 0) continue;
    block.bias[0] = std::min(block.bias[0], -normal_speed(block, u_before));
  }
}

bool RestitutionStage::spreads(std::span<const Vec6> u, double dt, std::span<const Block> blocks) {
  struck_.clear();
  std::fill(impact_.begin(), impact_.end(), 0.0);
  bool any = false;
  for (const Block& block : blocks) {
    const double speed = impact_speed(u, dt, block);
    if (speed == 0.0) continue;
    any = true;
    for (const int body : {block.a, block.b}) {
      if (body < 0) continue;
      double& most = impact_[index(body)];
      most = std::max(most, speed);
    }
  }
  if (!any) return false;
  const bool spread = std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    if (!block.is_contact() || restitution_of(block) == 0.0) return false;
    if (impact_speed(u, dt, block) > 0.0) return false;
    double change = 0.0;  // each body's speed changes by at most twice its fastest impact
    for (const int body : {block.a, block.b}) {
      if (body >= 0) change += 2.0 * impact_[index(body)];
    }
    return change > 0.0 && block.phi[0] + (normal_speed(block, u) - change) * dt < 0.0;
  });
  if (spread) struck_.assign(blocks.size(), 0);
  return spread;
}

bool RestitutionStage::set_impacts(std::span<const Vec6> u, double dt, std::span<Block> blocks) {
  bool any = false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Block& block = blocks[i];
    std::fill(std::begin(block.bias), std::end(block.bias), 0.0);
    std::fill(std::begin(block.impulse), std::end(block.impulse), 0.0);
    if (!block.is_contact()) continue;
    const double speed = impact_speed(u, dt, block);
    if (speed > 0.0) {
      any = true;
      struck_[i] = 1;
    }
    block.bias[0] = speed > 0.0 ? -restitution_of(block) * speed : kOpen;
    std::fill(std::begin(block.active_set), std::end(block.active_set), kUnknownSet);
  }
  return any;
}

}  // namespace substep
