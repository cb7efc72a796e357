#include "core/lab/planar_chain.hpp"

#include "core/forces/applied_forces.hpp"
#include "core/math/dense.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr double kPlanar = 1e-9;  // sine of the angle that still counts as none [-]

/// R(theta) v, sine and cosine given.
Vec2 turned(const Vec2& v, double sine, double cosine) {
  return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
}
double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

const Body& body_of(const Scene& scene, int index) {
  return scene.bodies[static_cast<std::size_t>(index)];
}

/// Initial position of a point fixed in a body or in the world.
Vec3 at_start(const Scene& scene, int body, const Vec3& point) {
  if (body == kWorld) return point;
  const Body& b = body_of(scene, body);
  return b.position + b.orientation * point;
}

}  // namespace

std::optional<std::vector<PlanarChain::Hinge>> PlanarChain::hinges_outwards(const Scene& scene) {
  std::vector<Hinge> hinges;
  std::vector<bool> used(scene.joints.size(), false);
  while (hinges.size() < scene.joints.size()) {
    const std::size_t before = hinges.size();
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      if (used[j]) continue;
      const auto* joint = std::get_if<HingeJoint>(&scene.joints[j]);
      if (!joint) return std::nullopt;
      const auto hangs_on = [&](int body) {
        return hinges.empty() ? is_fixed(scene, body) : body == hinges.back().child;
      };
      const bool a_is_child = hangs_on(joint->b);
      if (!a_is_child && !hangs_on(joint->a)) continue;
      Hinge hinge;
      hinge.child = a_is_child ? joint->a : joint->b;
      if (is_fixed(scene, hinge.child)) return std::nullopt;
      hinge.at = at_start(scene, joint->a, joint->anchor_a);
      hinge.axis = body_of(scene, joint->a).orientation * joint->axis_a;
      hinge.axis_in_child = a_is_child ? joint->axis_a : joint->axis_b;
      hinges.push_back(hinge);
      used[j] = true;
      break;
    }
    if (hinges.size() == before) return std::nullopt;  // a fork, a loop, or a second chain
  }
  return hinges;
}

std::optional<PlanarChain> PlanarChain::of(const Scene& scene) {
  if (!is_runnable(scene)) return std::nullopt;
  if (has_applied_forces(scene.effects, {&Effects::gravity})) return std::nullopt;
  if (scene.effects.contact || acts_on_coordinates(scene.effects)) return std::nullopt;
  if (!scene.effects.joints || scene.joints.empty()) return std::nullopt;
  std::size_t moving = 0;
  for (const Body& body : scene.bodies) moving += body.is_static ? 0 : 1;
  if (moving != scene.joints.size()) return std::nullopt;
  const auto hinges = hinges_outwards(scene);
  if (!hinges) return std::nullopt;

  PlanarChain chain;
  chain.anchor_ = hinges->front().at;
  chain.axis_ = hinges->front().axis.normalized();
  chain.e1_ = chain.axis_.unitOrthogonal();
  chain.e2_ = chain.axis_.cross(chain.e1_);
  if (scene.effects.gravity) chain.gravity_ = scene.gravity;
  const auto in_plane = [&](const Vec3& v) { return Vec2(chain.e1_.dot(v), chain.e2_.dot(v)); };

  chain.y_.setZero(2 * static_cast<Eigen::Index>(hinges->size()));
  Vec3 speed_at_hinge = Vec3::Zero();
  for (std::size_t i = 0; i < hinges->size(); ++i) {
    const Hinge& hinge = (*hinges)[i];
    const Body& body = body_of(scene, hinge.child);
    const Vec3& axis = hinge.axis_in_child;
    Link link;
    link.body = hinge.child;
    link.mass = body.mass;
    link.inertia = axis.dot(body.inertia.cwiseProduct(axis));
    link.e = in_plane(body.position - hinge.at);
    link.across = chain.axis_.dot(body.position - chain.anchor_);
    if (i + 1 < hinges->size()) link.L = in_plane((*hinges)[i + 1].at - hinge.at);
    const Vec3& omega = body.angular_velocity;
    const Vec3 speed = speed_at_hinge + omega.cross(body.position - hinge.at);
    const double size = 1.0 + body.velocity.norm() + omega.norm();
    const bool planar =
        chain.axis_.cross(hinge.axis).norm() < kPlanar &&
        (body.inertia.cwiseProduct(axis) - link.inertia * axis).norm() <= kPlanar * link.inertia &&
        chain.axis_.cross(omega).norm() <= kPlanar * size &&
        (body.velocity - speed).norm() <= kPlanar * size;
    if (!planar) return std::nullopt;
    chain.y_[static_cast<Eigen::Index>(hinges->size() + i)] = chain.axis_.dot(omega);
    if (i + 1 < hinges->size()) {
      speed_at_hinge += omega.cross((*hinges)[i + 1].at - hinge.at);
    }
    chain.links_.push_back(link);
  }
  chain.derive();
  return chain;
}

void PlanarChain::derive() {
  double beyond = 0.0;
  for (std::size_t k = links_.size(); k-- > 0;) {
    Link& link = links_[k];
    link.P = link.mass * link.e + beyond * link.L;
    link.diagonal = link.inertia + link.mass * link.e.squaredNorm() + beyond * link.L.squaredNorm();
    beyond += link.mass;
  }
}

void PlanarChain::slope(const Vector& y, Vector& dy) const {
  const auto n = static_cast<Eigen::Index>(links_.size());
  const Vec2 g(e1_.dot(gravity_), e2_.dot(gravity_));
  Eigen::MatrixXd M(n, n);
  Vector force(n);
  std::vector<Vec2> L(links_.size());
  std::vector<Vec2> P(links_.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double sine = std::sin(y[k]);
    const double cosine = std::cos(y[k]);
    L[i] = turned(links_[i].L, sine, cosine);
    P[i] = turned(links_[i].P, sine, cosine);
    M(k, k) = links_[i].diagonal;
    force[k] = cross(P[i], g);  // g . R'(theta) P
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index j = 0; j < k; ++j) {
      const Vec2& L_j = L[static_cast<std::size_t>(j)];
      const Vec2& P_k = P[static_cast<std::size_t>(k)];
      M(k, j) = L_j.dot(P_k);  // the factorisation reads the lower half
      const double C = cross(L_j, P_k);
      force[k] -= C * y[n + j] * y[n + j];
      force[j] += C * y[n + k] * y[n + k];
    }
  }
  dy.resize(2 * n);
  dy.head(n) = y.tail(n);
  dy.tail(n) = Cholesky(M).solve(force);
}

void PlanarChain::advance(double seconds) {
  integrator_.advance([this](const Vector& y, Vector& dy) { slope(y, dy); }, seconds, y_);
}

Vec3 PlanarChain::centre(int body) const {
  Vec2 at = Vec2::Zero();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const double theta = y_[static_cast<Eigen::Index>(i)];
    const bool is_last = link.body == body;
    at += turned(is_last ? link.e : link.L, std::sin(theta), std::cos(theta));
    if (is_last) return anchor_ + at.x() * e1_ + at.y() * e2_ + link.across * axis_;
  }
  return Vec3::Zero();
}

double PlanarChain::kinetic() const {
  const auto n = static_cast<Eigen::Index>(links_.size());
  double energy = 0.0;
  Vec2 at_hinge = Vec2::Zero();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Link& link = links_[static_cast<std::size_t>(k)];
    const double omega = y_[n + k];
    const auto speed = [&](const Vec2& arm) {
      const Vec2 r = turned(arm, std::sin(y_[k]), std::cos(y_[k]));
      return Vec2(-omega * r.y(), omega * r.x());
    };
    energy += 0.5 * link.mass * (at_hinge + speed(link.e)).squaredNorm() +
              0.5 * link.inertia * omega * omega;
    at_hinge += speed(link.L);
  }
  return energy;
}

double PlanarChain::length() const {
  double length = links_.back().e.norm();
  for (const Link& link : links_) length += link.L.norm();
  return length;
}

double PlanarChain::weight() const {
  double mass = 0.0;
  for (const Link& link : links_) mass += link.mass;
  return mass * gravity_.norm();
}

}  // namespace substep
