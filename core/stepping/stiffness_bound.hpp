#pragma once

#include <span>

#include "core/constraints/block.hpp"
#include "core/constraints/contact.hpp"
#include "core/constraints/stiffness_matrix.hpp"
#include "core/model/part.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// The body and degree of freedom with the largest k/M. body = -1 if K is zero.
struct StiffnessLeader {
  int body = -1;
  int dof = 0;        // 0..2 linear, 3..5 about the body's principal axes
  double k = 0.0;     // K_d,i [N/m or N m/rad]
  double mass = 0.0;  // M_ii [kg or kg m^2]
  double r = 0.0;     // k / mass, Eq. 9 [1/s^2]
};

/// Evaluates K from the forces and arms of a sub-step (Eq. 1), and its diagonal (Eq. 4).
class StiffnessStage {
 public:
  explicit StiffnessStage(const Scene& scene);
  /// @param blocks of the part, with lambda and the matching geometry
  /// @param k out, per body of the part: linear [N/m], then angular about the principal axes
  /// [N m/rad]
  void evaluate(std::span<const Block> blocks, ContactTerms terms, const Part& part,
                std::span<const Mat3> R_WB, std::vector<Vec6>& k);
  /// r = max k_i / M_ii over the moving ones of these bodies (Eq. 9).
  [[nodiscard]] static StiffnessLeader bound(const Scene& scene, std::span<const int> bodies,
                                             std::span<const Vec6> k);
  [[nodiscard]] const StiffnessMatrix& matrix() const { return K_; }

 private:
  StiffnessMatrix K_;
};

}  // namespace substep
