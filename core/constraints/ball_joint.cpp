#include "core/constraints/ball_joint.hpp"

#include <algorithm>

namespace substep {

void BallRows::constants(const JointBase& joint, Block& block) {
  block.rows = block.position_rows = 3;
  block.has_point_rows = true;
  std::fill_n(block.active_set, kMaxRows, std::int8_t{0});  // rows of joints have no bounds
  for (int i = 0; i < 3; ++i) block.C[i] = joint.compliance;
}

// An arm r rotating with omega: r'' = omega x (omega x r).
void BallRows::curvature(const Block& block, const Vec6& u_a, const Vec6& u_b, double* curvature) {
  const Vec3 omega_a = u_a.tail<3>();
  const Vec3 omega_b = u_b.tail<3>();
  const Vec3 c = omega_a.cross(omega_a.cross(block.r_a)) - omega_b.cross(omega_b.cross(block.r_b));
  for (int i = 0; i < 3; ++i) curvature[i] = c[i];
}

void BallRows::move(const Block& start, const Motion& a, const Motion& b, RowRange rows,
                    Block& moved) {
  if (!rows.reaches(0, 3)) return;
  moved.r_a = a.R * start.r_a;
  moved.r_b = b.R * start.r_b;
  const Vec3 phi = (a.dx - b.dx) + ((moved.r_a - start.r_a) - (moved.r_b - start.r_b));
  for (int i = 0; i < 3; ++i) moved.phi[i] = phi[i];
}

void BallRows::moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
  const Vec3 r_a = a.R * start.r_a;
  const Vec3 r_b = b.R * start.r_b;
  const Vec3 gap = (a.dx - b.dx) + ((r_a - start.r_a) - (r_b - start.r_b));
  for (int i = 0; i < 3; ++i) phi[i] = gap[i];
}

// The force is constant, and each arm rotates with its body.
void BallRows::push_change(const Block& block, const Motion& a, const Motion& b,
                           const double* force, Vec6& on_a, Vec6& on_b) {
  const Vec3 f{force[0], force[1], force[2]};
  on_a.tail<3>() += (a.R * block.r_a - block.r_a).cross(f);
  on_b.tail<3>() -= (b.R * block.r_b - block.r_b).cross(f);
}

}  // namespace substep
