#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"
#include "core/constraints/stiffness_matrix.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {

/// Evaluates K from the forces and arms of a sub-step (Eq. 1), and its diagonal (Eq. 4).
class StiffnessStage {
 public:
  explicit StiffnessStage(const Scene& scene);
  /// @param blocks of the part, with lambda and the matching geometry
  /// @param k out, per body of the part: linear [N/m], then angular about the principal axes
  /// [N m/rad]
  void evaluate(const Scene& scene, std::span<const Block> blocks, ContactTerms terms,
                const Part& part, std::span<const Mat3> R_WB, std::vector<Vec6>& k);
  /// r = max k_i / M_ii over the moving ones of these bodies (Eq. 9).
  [[nodiscard]] static StiffnessLeader bound(const Scene& scene, std::span<const int> bodies,
                                             std::span<const Vec6> k);
  [[nodiscard]] const StiffnessMatrix& matrix() const { return K_; }

 private:
  StiffnessMatrix K_;
};

}  // namespace substep
