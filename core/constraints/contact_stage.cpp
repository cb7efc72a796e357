#include "core/constraints/contact_stage.hpp"

#include <algorithm>
#include <cmath>

namespace substep {

bool ContactStage::detect_and_append(const Scene& scene, const State& state,
                                     std::span<const Mat3> R_WB, Blocks& blocks) {
  const std::span<const ContactPoint> points = detector_.detect(scene, state, R_WB);
  if (detector_.too_many()) return false;
  for (const ContactPoint& point : points) {
    const auto a = static_cast<std::size_t>(point.a);
    const auto b = static_cast<std::size_t>(point.b);
    Block& block = blocks.append();
    block.a = scene.bodies[a].is_static ? -1 : point.a;
    block.b = scene.bodies[b].is_static ? -1 : point.b;
    contact_row(point, scene.contact, state.x[a], state.x[b], block);
  }
  return true;
}

double ContactStage::penetration(const Scene& scene, const State& state,
                                 std::span<const Mat3> R_WB) {
  double deepest = 0.0;
  for (const ContactPoint& point : detector_.detect(scene, state, R_WB)) {
    deepest = std::max(deepest, -point.gap);
  }
  return deepest;
}

FrictionStage::FrictionStage(const Scene& scene) {
  for (const Body& body : scene.bodies) sqrt_mu_.push_back(std::sqrt(body.friction));
}

void FrictionStage::append(const Scene& scene, std::span<const Mat3> R_WB, Blocks& blocks) const {
  for (Block& block : blocks.all()) {
    if (!block.is_contact()) continue;
    const auto a = static_cast<std::size_t>(block.body_a);
    const auto b = static_cast<std::size_t>(block.body_b);
    const double mu = sqrt_mu_[a] * sqrt_mu_[b];
    if (mu > 0.0) friction_rows(scene.contact, mu, R_WB[b], block);
  }
}

}  // namespace substep
