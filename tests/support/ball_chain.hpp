#pragma once
// The exact motion of boxes on ball joints, each hanging from the previous one, in minimal
// coordinates: an independent reference for the tests, which shares no code with the lab's.

#include <vector>

#include "core/model/scene.hpp"
#include "tests/support/dense_oracle.hpp"

namespace substep::test {

/// A chain from a fixed point. Link i turns with omega_i (world); with rho_ij the way from joint j
/// to joint j + 1 (j < i) or to the centre of link i (j = i),
///   x_i = anchor + sum_j rho_ij,   a_i = sum_j (alpha_j x rho_ij + omega_j x (omega_j x rho_ij)),
/// and d'Alembert's principle for each omega_k reads
///   sum_i rho_ik x m_i (a_i - g) + I_k alpha_k + omega_k x I_k omega_k = 0.
/// A classical Runge-Kutta method of fourth order integrates it.
class BallChain {
 public:
  struct Link {
    double mass = 1.0;            // [kg]
    Vec3 inertia = Vec3::Ones();  // principal, about the centre [kg m^2]
    Vec3 to_centre;               // from its joint, body frame [m]
    Vec3 to_next;                 // from its joint to the next, body frame [m]
    Quat q = Quat::Identity();    // q_WB
    Vec3 omega = Vec3::Zero();    // world [rad/s]
  };

  BallChain(std::vector<Link> links, const Vec3& gravity)
      : links_(std::move(links)), gravity_(gravity) {}

  void advance(double seconds, int steps) {
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) step(h);
  }
  [[nodiscard]] Vec3 centre(std::size_t link) const {
    Vec3 x = Vec3::Zero();
    for (std::size_t j = 0; j <= link; ++j) {
      x += links_[j].q * (j < link ? links_[j].to_next : links_[j].to_centre);
    }
    return x;
  }
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

  /// The same chain as a scene on the origin; links do not touch.
  [[nodiscard]] Scene scene() const {
    Scene scene;
    scene.gravity = gravity_;
    scene.effects.gravity = !gravity_.isZero(0.0);
    scene.effects.gyroscopic = scene.effects.joints = true;
    Vec3 joint = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      Body body;
      body.name = "link" + std::to_string(i);
      body.shape = Sphere{0.1};
      body.mass = link.mass;
      body.inertia = link.inertia;
      body.position = joint + link.q * link.to_centre;
      body.orientation = link.q;
      body.velocity = velocity + link.omega.cross(link.q * link.to_centre);
      body.angular_velocity = link.omega;
      body.collides = false;
      scene.bodies.push_back(body);
      BallJoint ball;
      ball.name = "joint" + std::to_string(i);
      ball.a = static_cast<int>(i);
      ball.b = i == 0 ? kWorld : static_cast<int>(i) - 1;
      ball.anchor_a = -link.to_centre;
      if (i > 0) ball.anchor_b = links_[i - 1].to_next - links_[i - 1].to_centre;
      scene.joints.emplace_back(ball);
      joint += link.q * link.to_next;
      velocity += link.omega.cross(link.q * link.to_next);
    }
    return scene;
  }

 private:
  using Vector = Eigen::VectorXd;

  [[nodiscard]] Vector accelerations(const std::vector<Link>& links) const {
    const auto n = static_cast<Eigen::Index>(links.size());
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    Vector Q = Vector::Zero(3 * n);
    std::vector<Vec3> rho(links.size());  // of the previous links
    Vec3 carried = Vec3::Zero();          // centripetal, of the joint [m/s^2]
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Link& link = links[i];
      rho[i] = link.q * link.to_centre;
      const Vec3 a = carried + link.omega.cross(link.omega.cross(rho[i])) - gravity_;
      const Mat3 R = link.q.toRotationMatrix();
      const Mat3 I = R * link.inertia.asDiagonal() * R.transpose();
      for (std::size_t k = 0; k <= i; ++k) {
        const auto row = static_cast<Eigen::Index>(3 * k);
        Q.segment<3>(row) -= link.mass * rho[k].cross(a);
        for (std::size_t j = 0; j <= i; ++j) {
          M.block<3, 3>(row, static_cast<Eigen::Index>(3 * j)) -=
              link.mass * skew(rho[k]) * skew(rho[j]);
        }
      }
      const auto own = static_cast<Eigen::Index>(3 * i);
      M.block<3, 3>(own, own) += I;
      Q.segment<3>(own) -= link.omega.cross(I * link.omega);
      rho[i] = link.q * link.to_next;
      carried += link.omega.cross(link.omega.cross(rho[i]));
    }
    return solved(M, Q);
  }

  // Quaternions as vectors of four, q' = (0, omega) q / 2, normalised after the step.
  void step(double h) {
    struct Slope {
      std::vector<Eigen::Vector4d> q;
      Vector omega;
    };
    const auto slope = [&](const std::vector<Link>& links) {
      Slope s;
      for (const Link& link : links) {
        const Quat w(0.0, link.omega.x(), link.omega.y(), link.omega.z());
        s.q.push_back(0.5 * (w * link.q).coeffs());
      }
      s.omega = accelerations(links);
      return s;
    };
    const auto moved = [&](const Slope& s, double by) {
      std::vector<Link> links = links_;
      for (std::size_t i = 0; i < links.size(); ++i) {
        links[i].q.coeffs() += by * s.q[i];
        links[i].omega += by * s.omega.segment<3>(static_cast<Eigen::Index>(3 * i));
      }
      return links;
    };
    const Slope k1 = slope(links_);
    const Slope k2 = slope(moved(k1, 0.5 * h));
    const Slope k3 = slope(moved(k2, 0.5 * h));
    const Slope k4 = slope(moved(k3, h));
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      links_[i].q.coeffs() += h / 6.0 * (k1.q[i] + 2.0 * k2.q[i] + 2.0 * k3.q[i] + k4.q[i]);
      links_[i].q.normalize();
      links_[i].omega +=
          h / 6.0 * (k1.omega + 2.0 * k2.omega + 2.0 * k3.omega + k4.omega).segment<3>(at);
    }
  }

  std::vector<Link> links_;
  Vec3 gravity_;
};

}  // namespace substep::test
