#include "core/stepping/stiffness_bound.hpp"

#include "core/constraints/ball_joint.hpp"
#include "core/constraints/contact.hpp"
#include "core/constraints/hinge_joint.hpp"

namespace substep {

StiffnessStage::StiffnessStage(const Scene& scene) {
  K_.reserve(scene.bodies.size(), 2 * scene.joints.size() + 4 * scene.bodies.size());
}

void StiffnessStage::evaluate(std::span<const Block> blocks, ContactStiffness form,
                              std::span<const Mat3> R_WB, std::vector<Vec6>& k) {
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
  k.resize(R_WB.size());
  K_.column_norms(R_WB, k);
}

StiffnessBound StiffnessStage::bound(const Scene& scene, std::span<const Vec6> k) {
  StiffnessBound best;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    for (int dof = 0; dof < 6; ++dof) {
      const double mass = dof < 3 ? body.mass : body.inertia[dof - 3];
      const double r = k[i][dof] / mass;
      if (r > best.r) best = {r, static_cast<int>(i), dof, k[i][dof], mass};
    }
  }
  return best;
}

}  // namespace substep
