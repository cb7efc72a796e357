#include "core/constraints/contact.hpp"

namespace substep {

// C     = D(p) - radius, with n = grad D
// dC/dt = n . (v_a + omega_a x r_a - v_b - omega_b x r_b)
// The components of r_a and r_b along n drop out of the cross products, so any point between the
// surfaces is valid. Both bodies use the midpoint: friction is then one force at one point, and
// angular momentum is conserved.
void contact_row(const ContactPoint& point, const ContactModel& model, const Vec3& x_a,
                 const Vec3& x_b, Block& block) {
  block.kind = BlockKind::kContact;
  block.id = point.id;
  block.body_a = point.a;
  block.body_b = point.b;
  block.rows = 1;
  block.lo = 0.0;
  block.hi = kUnbounded;
  block.awaits = false;
  block.has_point_rows = false;
  const Vec3 b_from_a = x_b - x_a;
  const Vec3 r_a = 0.5 * (point.point_a + (b_from_a + point.point_b));
  const Vec3 r_b = 0.5 * (point.point_b + (point.point_a - b_from_a));
  block.n = point.n;
  block.r_a = r_a;
  block.r_b = r_b;
  block.arm_a = point.field_arm;
  block.rho = (x_a - x_b) + point.field_arm;
  block.H = point.H;
  block.mu = 0.0;
  block.phi[0] = point.gap;
  block.C[0] = model.compliance;
  block.soft = is_soft(model);
  block.spring_ahead[0] = block.curved = 0.0;
  set_row(block, 0, point.n);
}

double normal_speed(const Block& contact, std::span<const Vec6> u) {
  double speed = 0.0;
  for (int j = 0; j < 6; ++j) {
    if (contact.a >= 0) speed += contact.J_a[0][j] * u[index(contact.a)][j];
    if (contact.b >= 0) speed += contact.J_b[0][j] * u[index(contact.b)][j];
  }
  return speed;
}

void friction_rows(const ContactModel& model, double mu, const Vec3& along, Block& block) {
  block.t1 = (along - block.n * block.n.dot(along)).normalized();
  block.t2 = block.n.cross(block.t1);
  block.mu = mu;
  block.share[0] = block.share[1] = 1.0;
  block.sliding = block.across = 0.0;
  block.rows = 3;
  for (int row = 1; row < 3; ++row) {
    block.phi[row] = 0.0;  // no position correction for tangential slip
    block.C[row] = model.friction_compliance;
    set_row(block, row, row == 1 ? block.t1 : block.t2);
  }
}

namespace {

using Mat36 = Eigen::Matrix<double, 3, 6>;  // derivative by a displacement: linear, angular

void add_paper_stiffness(const Block& block, StiffnessMatrix& K) {
  Vec3 l = block.lambda[0] * block.n;
  if (block.rows == 3) l += block.lambda[1] * block.t1 + block.lambda[2] * block.t2;
  if (block.a >= 0) K.add_angular(block.a, block.a, skew_product(l, block.r_a));
  if (block.b >= 0) K.add_angular(block.b, block.b, -skew_product(l, block.r_b));
}

/// Adds the derivatives of the force and the torque on one body by the displacement of another.
void add_pair(int on, int by, const auto& force, const auto& torque, StiffnessMatrix& K) {
  if (on < 0 || by < 0) return;
  Mat6 block;
  block << force, torque;
  K.add(on, by, block);
}

// The force on a is l n at p = x_a + r (r = arm_a, rotating with a), that on b is -l n with the
// torque -l rho x n about x_b, rho = p - x_b. The normal rotates with b and changes with p in b's
// distance field:
//   dn = theta_b x n + H (dp - theta_b x rho),   dp = dx_a - dx_b + theta_a x r
// Written with matrices: dn = N_b theta_b + H (dx_a - dx_b - [r] theta_a), N_b = H [rho] - [n].
// Then  d(l n)            = l dn
//       d(l r x n)        = l ([n][r] theta_a + [r] dn)
//       d(-l rho x n)     = l ([n](dx_a - dx_b - [r] theta_a) - [rho] dn).
// For a face H = 0 and the blocks are those of a point on a plate; for two spheres N_b = 0 and only
// l H remains.
void add_normal_stiffness(const Block& block, StiffnessMatrix& K) {
  const double l = block.lambda[0];
  if (l == 0.0) return;
  const Mat3 n = skew(block.n);
  const Mat3 r = skew(block.arm_a);
  const Mat3 rho = skew(block.rho);
  const Mat3& H = block.H;
  const Mat3 N_b = H * rho - n;
  const Mat3 Hr = H * r;

  // Derivative of n by the displacement of each body.
  Mat36 dn_a;
  Mat36 dn_b;
  dn_a << H, -Hr;
  dn_b << -H, N_b;

  Mat36 torque_a_by_a = r * dn_a;
  torque_a_by_a.rightCols<3>() += n * r;
  Mat36 torque_b_by_a = -rho * dn_a;
  torque_b_by_a.leftCols<3>() += n;
  torque_b_by_a.rightCols<3>() -= n * r;
  Mat36 torque_b_by_b = -rho * dn_b;
  torque_b_by_b.leftCols<3>() -= n;

  add_pair(block.a, block.a, l * dn_a, l * torque_a_by_a, K);
  add_pair(block.b, block.b, -l * dn_b, l * torque_b_by_b, K);
  add_pair(block.a, block.b, l * dn_b, l * (r * dn_b), K);
  add_pair(block.b, block.a, -l * dn_a, l * torque_b_by_a, K);
}

// Friction is the force g = l_1 t1 + l_2 t2 on a at the arm r_a, -g on b at r_b. The tangents
// rotate with b and stay perpendicular to the normal; the point of action keeps its distance s from
// p along the normal, r_a = r + s n, r_b = rho + s n. With dn and dp as above
//   dt = -n (t . dn) + (n . theta_b) n x t,   dg = -n (g . dn) + (n . theta_b) n x g,
//   dr_a = theta_a x r + s dn,   dr_b = dp + s dn,
//   d(r_a x g) = -[g] dr_a + [r_a] dg,   d(-r_b x g) = [g] dr_b - [r_b] dg.
void add_friction_stiffness(const Block& block, StiffnessMatrix& K) {
  const Vec3 g = block.lambda[1] * block.t1 + block.lambda[2] * block.t2;
  if (g.isZero(0.0)) return;
  const Vec3& n = block.n;
  const Mat3 r = skew(block.arm_a);
  Mat36 dn_a;
  Mat36 dn_b;
  dn_a << block.H, -(block.H * r);
  dn_b << -block.H, block.H * skew(block.rho) - skew(n);

  const Mat36 dg_a = -n * (g.transpose() * dn_a);
  Mat36 dg_b = -n * (g.transpose() * dn_b);
  dg_b.rightCols<3>() += n.cross(g) * n.transpose();

  const double s = (block.r_a - block.arm_a).dot(n);
  Mat36 dr_a_by_a = s * dn_a;
  dr_a_by_a.rightCols<3>() -= r;
  const Mat36 dr_a_by_b = s * dn_b;
  Mat36 dr_b_by_a = dr_a_by_a;
  dr_b_by_a.leftCols<3>() += Mat3::Identity();
  Mat36 dr_b_by_b = dr_a_by_b;
  dr_b_by_b.leftCols<3>() -= Mat3::Identity();

  const Mat3 G = skew(g);
  const Mat3 r_a = skew(block.r_a);
  const Mat3 r_b = skew(block.r_b);
  add_pair(block.a, block.a, dg_a, r_a * dg_a - G * dr_a_by_a, K);
  add_pair(block.b, block.b, -dg_b, G * dr_b_by_b - r_b * dg_b, K);
  add_pair(block.a, block.b, dg_b, r_a * dg_b - G * dr_a_by_b, K);
  add_pair(block.b, block.a, -dg_a, G * dr_b_by_a - r_b * dg_a, K);
}

}  // namespace

void contact_stiffness(const Block& block, ContactTerms terms, StiffnessMatrix& K) {
  if (terms == ContactTerms::kPaper) return add_paper_stiffness(block, K);
  add_normal_stiffness(block, K);
  if (terms == ContactTerms::kExact && block.rows == 3) add_friction_stiffness(block, K);
}

}  // namespace substep
