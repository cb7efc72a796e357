#include "core/constraints/grab_rows.hpp"

#include "core/constraints/joint_rows.hpp"

#include <cmath>

namespace substep {

void grab_rows(const Grab& grab, const Side& body, Block& block) {
  block.kind = kind_of(BallJoint{});
  block.id = kGrabId;
  block.a = block.body_a = grab.body;
  block.b = block.body_b = -1;
  BallRows::constants(JointBase{}, block);
  BallRows::rows({grab.anchor, grab.target}, body, Side{}, block);
  double* phi = block.phi;
  const double distance = std::sqrt(phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2]);
  if (distance <= Grab::kReach) return;
  for (int row = 0; row < 3; ++row) phi[row] *= Grab::kReach / distance;
}

void soften_grab(const Grab& grab, double dt, Block& block) {
  const double k = grab.stiffness();
  const double resistance = grab.damping() + dt * k;
  for (int row = 0; row < block.rows; ++row) {
    block.softness[row] = 1.0 / (dt * resistance);
    block.bias[row] = k * block.phi[row] / resistance;
  }
}

}  // namespace substep
