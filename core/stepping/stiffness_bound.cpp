#include "core/stepping/stiffness_bound.hpp"

#include "core/constraints/ball_joint.hpp"
#include "core/constraints/contact.hpp"
#include "core/constraints/hinge_joint.hpp"
#include "core/solver/flops.hpp"

namespace substep {
namespace {

constexpr std::int64_t kProduct = product_flops(3, 3, 3);
constexpr std::int64_t kSkewProduct = 12;
constexpr std::int64_t kSum = 9;

std::int64_t exact_contact_flops(std::int64_t bodies) {
  const std::int64_t normal = 2 * kProduct + kSum;  // N_b, H r
  const std::int64_t torques =
      4 * product_flops(3, 3, 6) + 2 * kProduct + 5 * kSum;  // by each body
  return normal + torques + bodies * bodies * 2 * 36;        // scaled, added
}

/// Of adding one block to K, as core/constraints/ does it.
std::int64_t block_flops(const Block& block, ContactStiffness form) {
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  const std::int64_t ball = bodies * (kSkewProduct + kSum);
  switch (block.kind) {
    case BlockKind::kBall:
      return ball;
    case BlockKind::kHinge:  // w, W U, on each body and between both
      return ball + 9 + kSkewProduct + bodies * bodies * kSum;
    case BlockKind::kContact:
      if (form == ContactStiffness::kPaper) return 3 + (block.rows == 3 ? 12 : 0) + ball;
      return block.lambda[0] == 0.0 ? 0 : exact_contact_flops(bodies);
  }
  return 0;
}

}  // namespace

StiffnessStage::StiffnessStage(const Scene& scene) {
  const std::size_t joints = scene.effects.joints ? 2 * scene.joints.size() : 0;
  const std::size_t contacts = scene.effects.contact ? 4 * scene.bodies.size() : 0;
  K_.reserve(scene.bodies.size(), joints + contacts);
}

void StiffnessStage::evaluate(std::span<const Block> blocks, ContactStiffness form,
                              const Part& part, std::span<const Mat3> R_WB, std::vector<Vec6>& k) {
  K_.clear(R_WB.size());
  for (const Block& block : blocks) {
    switch (block.kind) {
      case BlockKind::kBall:
        ball_stiffness(block, K_);
        break;
      case BlockKind::kHinge:
        hinge_stiffness(block, K_);
        break;
      case BlockKind::kContact:
        if (form == ContactStiffness::kPaper) {
          contact_stiffness_paper(block, K_);
        } else {
          contact_stiffness_exact(block, K_);
        }
        break;
    }
  }
  k.resize(R_WB.size(), Vec6::Zero());
  K_.column_norms(part.bodies, R_WB, k);
}

std::int64_t StiffnessStage::flops(std::span<const Block> blocks, ContactStiffness form) const {
  std::int64_t sum = K_.norm_flops();
  for (const Block& block : blocks) sum += block_flops(block, form);
  return sum;
}

StiffnessBound StiffnessStage::bound(const Scene& scene, std::span<const int> bodies,
                                     std::span<const Vec6> k) {
  StiffnessBound best;
  for (const int index : bodies) {
    const auto i = static_cast<std::size_t>(index);
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    for (int dof = 0; dof < 6; ++dof) {
      const double mass = dof < 3 ? body.mass : body.inertia[dof - 3];
      if (k[i][dof] < 0.999 * best.r * mass) continue;  // a division less
      const double r = k[i][dof] / mass;
      if (r > best.r) best = {r, index, dof, k[i][dof], mass};
    }
  }
  return best;
}

}  // namespace substep
