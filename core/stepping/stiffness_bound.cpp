#include "core/stepping/stiffness_bound.hpp"

#include <algorithm>

#include "core/constraints/joint_rows.hpp"
#include "core/model/joint_fields.hpp"

namespace substep {

StiffnessStage::StiffnessStage(const Scene& scene) {
  const std::size_t joints = scene.effects.joints ? 2 * scene.joints.size() : 0;
  const std::size_t contacts = scene.effects.contact ? 4 * scene.bodies.size() : 0;
  const bool ropes =  // they may become taut later
      scene.effects.limits && std::any_of(scene.joints.begin(), scene.joints.end(), rope_length_of);
  K_.reserve(scene.bodies.size(), joints + contacts, ropes);
}

void StiffnessStage::evaluate(const Scene& scene, std::span<const Block> blocks, ContactTerms terms,
                              const Part& part, std::span<const Mat3> R_WB, std::vector<Vec6>& k) {
  K_.clear(R_WB.size());
  for (const Block& block : blocks) {
    if (block.is_contact()) {
      contact_stiffness(block, terms, K_);
    } else {
      with_joint_rows(block.kind, [&](auto joint) {
        if constexpr (requires { joint.mean_stiffness(block, K_); }) {
          joint.mean_stiffness(block, K_);
        } else {
          joint.stiffness(block, K_);
        }
      });
    }
  }
  k.resize(R_WB.size(), Vec6::Zero());
  // Exact contact blocks keep the plain norm, in metres: with weights N becomes so small that
  // ragdoll_drop fails.
  const bool weighted = terms == ContactTerms::kPaper;
  K_.column_norms(part.bodies, scene.bodies, R_WB, weighted, k);
}

StiffnessLeader StiffnessStage::bound(const Scene& scene, std::span<const int> bodies,
                                      std::span<const Vec6> k) {
  StiffnessLeader best;
  for (const int index : bodies) {
    const auto i = static_cast<std::size_t>(index);
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    for (int dof = 0; dof < 6; ++dof) {
      const double mass = dof < 3 ? body.mass : body.inertia[dof - 3];
      if (k[i][dof] < 0.999 * best.r * mass) continue;  // avoids the division
      const double r = k[i][dof] / mass;
      if (r > best.r) best = {index, dof, k[i][dof], mass, r};
    }
  }
  return best;
}

}  // namespace substep
