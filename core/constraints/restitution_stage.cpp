#include "core/constraints/restitution_stage.hpp"

#include <algorithm>

namespace substep {
namespace {

/// Speed along the normal, positive when the bodies part [m/s].
double normal_speed(const Block& block, std::span<const Vec6> u) {
  double speed = 0.0;
  for (int j = 0; j < 6; ++j) {
    if (block.a >= 0) speed += block.J_a[0][j] * u[static_cast<std::size_t>(block.a)][j];
    if (block.b >= 0) speed += block.J_b[0][j] * u[static_cast<std::size_t>(block.b)][j];
  }
  return speed;
}

}  // namespace

RestitutionStage::RestitutionStage(const Scene& scene) {
  for (const Body& body : scene.bodies) e_.push_back(body.restitution);
}

void RestitutionStage::apply(const Scene& scene, std::span<const Vec6> u_before, double dt,
                             std::span<Block> blocks) const {
  for (Block& block : blocks) {
    if (!block.is_contact()) continue;
    const double e = std::max(e_[static_cast<std::size_t>(block.body_a)],
                              e_[static_cast<std::size_t>(block.body_b)]);
    if (e == 0.0) continue;
    const double approach = normal_speed(block, u_before);
    const bool closes = block.phi[0] + approach * dt < 0.0;
    if (!closes || approach > -scene.contact.restitution_speed) continue;
    block.bias[0] = std::min(block.bias[0], e * approach);
  }
}

}  // namespace substep
