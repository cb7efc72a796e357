#include "core/lab/articulated_inertia.hpp"

#include <Eigen/Cholesky>

namespace substep {

ArticulatedInertia ArticulatedInertia::of_body(double mass, const Mat3& I, const Vec3& r,
                                               const Vec3& omega) {
  ArticulatedInertia body;
  body.A = I - mass * skew_product(r, r);
  body.B = mass * skew(r);
  body.M = mass * Mat3::Identity();
  body.force_bias = mass * omega.cross(omega.cross(r));
  body.torque_bias = omega.cross(I * omega) + r.cross(body.force_bias);
  return body;
}

Vec3 ArticulatedInertia::ball_acceleration(const Vec3& a) const {
  return -A.llt().solve(Vec3(B * a + torque_bias));
}

ArticulatedInertia ArticulatedInertia::behind_ball() const {
  const Eigen::LLT<Mat3> factor(A);
  ArticulatedInertia left;
  left.A.setZero();
  left.B.setZero();
  left.M = M - B.transpose() * factor.solve(B);
  left.torque_bias.setZero();
  left.force_bias = force_bias - B.transpose() * factor.solve(torque_bias);
  return left;
}

ArticulatedInertia ArticulatedInertia::behind_hinge(const Vec3& h, double armature) const {
  const Vec3 Ah = A * h;
  const Vec3 Bh = B.transpose() * h;
  const double inertia = h.dot(Ah) + armature;
  const Vec3 per_torque = Ah / inertia;
  const Vec3 per_force = Bh / inertia;
  ArticulatedInertia left;
  left.A = A - per_torque * Ah.transpose();
  left.B = B - per_torque * Bh.transpose();
  left.M = M - per_force * Bh.transpose();
  left.torque_bias = torque_bias - h.dot(torque_bias) * per_torque;
  left.force_bias = force_bias - h.dot(torque_bias) * per_force;
  return left;
}

Vec6 ArticulatedInertia::free_acceleration() const {
  Mat6 whole;
  whole << M, B.transpose(), B, A;  // linear first
  Vec6 bias;
  bias << force_bias, torque_bias;
  return -whole.llt().solve(bias);
}

void ArticulatedInertia::add(const ArticulatedInertia& child, const Vec3& l, const Vec3& alpha_bias,
                             const Vec3& a_bias) {
  // torque += torque_c + l x force_c, with a_c = a - [l] alpha.
  const Mat3 lx = skew(l);
  const Mat3 lM = lx * child.M;
  const Mat3 Bl = child.B * lx;
  A += child.A - (Bl + Bl.transpose()) - lM * lx;
  B += child.B + lM;
  M += child.M;
  const Vec3 force = child.force(alpha_bias, a_bias);
  torque_bias += child.torque(alpha_bias, a_bias) + l.cross(force);
  force_bias += force;
}

}  // namespace substep
