#include "core/lab/joint_tree.hpp"

#include <cmath>

namespace substep {
namespace {

/// q' of a quaternion in y rotating with omega: (0, omega) q / 2. @param q w, x, y, z
Eigen::Vector4d quaternion_rate(const Eigen::Vector4d& q, const Vec3& omega) {
  const Quat rate = Quat(0.0, omega.x(), omega.y(), omega.z()) * Quat(q[0], q[1], q[2], q[3]);
  return 0.5 * Eigen::Vector4d(rate.w(), rate.x(), rate.y(), rate.z());
}

}  // namespace

const JointTree::Motion& JointTree::parent_of(const Node& node) const {
  return node.parent == kWorld ? world_ : motion_[index(node.parent)];
}

void JointTree::move_outwards(const Vector& y) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Motion& parent = parent_of(node);
    Motion& m = motion_[i];
    if (node.kind == Kind::kFree) {
      m.p = y.segment<3>(node.q);
      m.v = y.segment<3>(node.u);
    } else {
      m.l = parent.q_WB * node.l;
      const Vec3 v = parent.omega.cross(m.l);
      m.p = parent.p + m.l;
      m.v = parent.v + v;
      m.a_bias = parent.omega.cross(v);
    }
    if (node.kind == Kind::kHinge) {
      const double rate = y[node.u];
      const Vec3 half = y[node.q + 1] * node.axis;
      m.q_WB = parent.q_WB * node.at_start * Quat(y[node.q], half.x(), half.y(), half.z());
      // The integrator keeps length 1 only to its tolerance.
      m.q_WB.normalize();
      m.h = m.q_WB * node.axis;
      m.omega = parent.omega + rate * m.h;
      m.alpha_bias = parent.omega.cross(rate * m.h);
    } else {
      const Eigen::Index q = node.q + (node.kind == Kind::kFree ? 3 : 0);
      m.q_WB = Quat(y[q], y[q + 1], y[q + 2], y[q + 3]).normalized();
      m.omega = y.segment<3>(node.u + (node.kind == Kind::kFree ? 3 : 0));
    }
    const Mat3 R = m.q_WB.toRotationMatrix();
    m.r = R * node.r;
    m.I = R * node.inertia.asDiagonal() * R.transpose();
  }
}

void JointTree::collect_inertias() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Motion& m = motion_[i];
    m.inertia = ArticulatedInertia::of_body(nodes_[i].mass, m.I, m.r, m.omega);
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.parent == kWorld) continue;
    const Motion& m = motion_[i];
    const ArticulatedInertia left = node.kind == Kind::kHinge
                                        ? m.inertia.behind_hinge(m.h, node.armature)
                                        : m.inertia.behind_ball();
    motion_[index(node.parent)].inertia.add(left, m.l, m.alpha_bias, m.a_bias);
  }
}

void JointTree::accelerate_outwards(const Vector& y, Vector& dy) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Motion& parent = parent_of(node);
    Motion& m = motion_[i];
    if (node.kind == Kind::kFree) {
      const Vec6 both = m.inertia.free_acceleration();
      m.a = both.head<3>();
      m.alpha = both.tail<3>();
      dy.segment<3>(node.q) = m.v;
      dy.segment<4>(node.q + 3) = quaternion_rate(y.segment<4>(node.q + 3), m.omega);
      dy.segment<3>(node.u) = m.a + gravity_;
      dy.segment<3>(node.u + 3) = m.alpha;
      continue;
    }
    m.a = parent.a + parent.alpha.cross(m.l) + m.a_bias;
    if (node.kind == Kind::kBall) {
      m.alpha = m.inertia.ball_acceleration(m.a);
      dy.segment<4>(node.q) = quaternion_rate(y.segment<4>(node.q), m.omega);
      dy.segment<3>(node.u) = m.alpha;
    } else {
      const Vec3 before = parent.alpha + m.alpha_bias;
      const double acceleration = m.inertia.hinge_acceleration(m.h, node.armature, before, m.a);
      m.alpha = before + acceleration * m.h;
      const double half_rate = 0.5 * y[node.u];
      dy[node.q] = -half_rate * y[node.q + 1];
      dy[node.q + 1] = half_rate * y[node.q];
      dy[node.u] = acceleration;
    }
  }
}

void JointTree::slope(const Vector& y, Vector& dy) {
  dy.resize(y.size());
  move_outwards(y);
  collect_inertias();
  accelerate_outwards(y, dy);
}

// The equations of motion preserve the length of a quaternion; the integrator does so to its
// tolerance.
void JointTree::normalise() {
  for (const Node& node : nodes_) {
    if (node.kind == Kind::kHinge) {
      y_.segment<2>(node.q).normalize();
    } else {
      y_.segment<4>(node.q + (node.kind == Kind::kFree ? 3 : 0)).normalize();
    }
  }
}

double JointTree::attempt(double most) {
  const double step =
      integrator_.attempt([this](const Vector& y, Vector& dy) { slope(y, dy); }, most, y_);
  if (step > 0.0) normalise();
  slope(y_, dy_);
  return step;
}

// The rate of a ball joint in its own frame is w = R^T (omega - omega_p), so
// w' = R^T (alpha - alpha_p + omega x omega_p). That of a free body has no parent.
void JointTree::step_semi_implicit(double h) {
  struct After {
    Quat q_WB = Quat::Identity();
    Vec3 omega = Vec3::Zero();
  };
  std::vector<After> after(nodes_.size());
  const auto turned = [&](const Quat& q, const Vec3& omega_B) {
    const Vec3 half = 0.5 * h * omega_B;
    return (q * Quat(1.0, half.x(), half.y(), half.z())).normalized();
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Motion& m = motion_[i];
    const Motion& before = parent_of(node);
    const After& parent = node.parent == kWorld ? After{} : after[index(node.parent)];
    if (node.kind == Kind::kHinge) {
      const double rate = y_[node.u] += h * dy_[node.u];
      const double half = 0.5 * h * rate;
      const double c = y_[node.q];
      const double s = y_[node.q + 1];
      y_[node.q] = c - half * s;
      y_[node.q + 1] = s + half * c;
      y_.segment<2>(node.q).normalize();
      const Vec3 axis = y_[node.q + 1] * node.axis;
      after[i].q_WB = parent.q_WB * node.at_start * Quat(y_[node.q], axis.x(), axis.y(), axis.z());
      after[i].omega = parent.omega + rate * (after[i].q_WB * node.axis);
      continue;
    }
    const bool is_free = node.kind == Kind::kFree;
    const Vec3 omega_p = is_free ? Vec3(Vec3::Zero()) : before.omega;
    const Vec3 alpha_p = is_free ? Vec3(Vec3::Zero()) : before.alpha;
    const Vec3 rate = m.q_WB.conjugate() * Vec3(m.omega - omega_p) +
                      h * (m.q_WB.conjugate() * Vec3(m.alpha - alpha_p + m.omega.cross(omega_p)));
    const Quat in_parent = is_free ? m.q_WB : Quat(before.q_WB.conjugate() * m.q_WB);
    const Quat moved = turned(in_parent, rate);
    after[i].q_WB = is_free ? moved : Quat(parent.q_WB * moved);
    after[i].omega = after[i].q_WB * rate;
    if (!is_free) after[i].omega += parent.omega;
    if (is_free) {
      y_.segment<3>(node.u) += h * dy_.segment<3>(node.u);
      y_.segment<3>(node.q) += h * y_.segment<3>(node.u);
    }
    const Eigen::Index offset = is_free ? 3 : 0;
    const Quat& q = after[i].q_WB;
    y_.segment<4>(node.q + offset) << q.w(), q.x(), q.y(), q.z();
    y_.segment<3>(node.u + offset) = after[i].omega;
  }
  slope(y_, dy_);
}

void JointTree::advance(double seconds) {
  double left = seconds;
  while (left > Extrapolation::kRounding * seconds) left -= attempt(left);
}

const JointTree::Motion* JointTree::motion_of(int body) const {
  const int node = node_of_[index(body)];
  return node < 0 ? nullptr : &motion_[index(node)];
}

Vec3 JointTree::centre(int body) const {
  const Motion* m = motion_of(body);
  return m ? Vec3(m->p + m->r) : at_start_[index(body)].first;
}

Quat JointTree::orientation(int body) const {
  const Motion* m = motion_of(body);
  return m ? m->q_WB : at_start_[index(body)].second;
}

Vec6 JointTree::velocity(int body) const {
  Vec6 u = Vec6::Zero();
  if (const Motion* m = motion_of(body)) u << m->v + m->omega.cross(m->r), m->omega;
  return u;
}

Vec6 JointTree::reaction(int body) const {
  Vec6 both = Vec6::Zero();
  const int node = node_of_[index(body)];
  if (node < 0 || nodes_[index(node)].kind == Kind::kFree) return both;
  const Motion& m = motion_[index(node)];
  const Vec3 force = m.inertia.force(m.alpha, m.a);
  both << force, m.inertia.torque(m.alpha, m.a) - m.r.cross(force);
  return both;
}

double JointTree::kinetic() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Motion& m = motion_[i];
    energy += 0.5 * nodes_[i].mass * (m.v + m.omega.cross(m.r)).squaredNorm() +
              0.5 * m.omega.dot(m.I * m.omega);
    if (nodes_[i].armature == 0.0) continue;
    const double rate = m.h.dot(m.omega - parent_of(nodes_[i]).omega);
    energy += 0.5 * nodes_[i].armature * rate * rate;
  }
  return energy;
}

double JointTree::potential() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    energy -= nodes_[i].mass * gravity_.dot(motion_[i].p + motion_[i].r);
  }
  return energy;
}

double JointTree::stretch() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.kind == Kind::kFree) continue;
    const Motion& m = motion_[i];
    sum += node.compliance * (weight_ + m.inertia.force(m.alpha, m.a).norm());
    // Bending of a hinge moves its subtree.
    sum += node.angular_compliance * m.inertia.torque(m.alpha, m.a).norm() * reach_;
  }
  return sum;
}

}  // namespace substep
