#pragma once

#include <optional>
#include <vector>

#include "core/lab/extrapolation.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The exact motion of links on parallel hinges that hang from one fixed point, in minimal
/// coordinates: one angle per link, hence no constraint error.
///
/// Link i is rotated by theta_i from its start, so its centre is at
///   x_i = anchor + sum_{j<i} R(theta_j) L_j + R(theta_i) e_i,
/// with e from a link's own hinge to its centre and L to the next hinge, in their initial
/// orientation. Lagrange's equations of the second kind then read, with P_k = m_k e_k + sum_{i>k}
/// m_i L_k,
///   sum_j M_kj theta_j'' = Q_k - sum_j C_kj theta_j'^2,   and for j < k:
///   M_kj = R(theta_j) L_j . R(theta_k) P_k,   C_kj = R(theta_j) L_j x R(theta_k) P_k = -C_jk,
///   M_kk = I_k + m_k e_k^2 + sum_{i>k} m_i L_k^2,   Q_k = g . R'(theta_k) P_k.
class PlanarChain {
 public:
  /// The chain of the scene, or nothing for other scenes: contact, a fork, a ball joint, external
  /// forces, non-parallel hinges, or a start with motion out of the plane.
  static std::optional<PlanarChain> of(const Scene& scene);

  void advance(double seconds);

  /// Centre of a body of the scene, world [m].
  [[nodiscard]] Vec3 centre(int body) const;
  [[nodiscard]] double kinetic() const;  ///< [J]
  /// Weight of all links [N]: how far a compliance can stretch a hinge.
  [[nodiscard]] double weight() const;
  /// Length from the fixed point to the last centre, fully extended [m].
  [[nodiscard]] double length() const;
  [[nodiscard]] int size() const { return static_cast<int>(links_.size()); }

 private:
  using Vector = VecX;
  struct Link {
    int body = 0;           // index into Scene::bodies
    double mass = 0.0;      // [kg]
    double inertia = 0.0;   // about the hinge's axis [kg m^2]
    Vec2 e = Vec2::Zero();  // from its hinge to its centre, at the start [m]
    Vec2 L = Vec2::Zero();  // from its hinge to the next, at the start [m]
    Vec2 P = Vec2::Zero();  // m e + (mass beyond) L [kg m]
    double diagonal = 0.0;  // M_kk [kg m^2]
    double across = 0.0;    // of its centre, along the axis from the anchor [m]
  };
  /// The hinge between a link and the one before it.
  struct Hinge {
    int child = 0;              // index into Scene::bodies
    Vec3 at = Vec3::Zero();     // world, at the start [m]
    Vec3 axis = Vec3::UnitZ();  // world, at the start
    Vec3 axis_in_child = Vec3::UnitZ();
  };
  static std::optional<std::vector<Hinge>> hinges_outwards(const Scene& scene);
  void derive();
  /// y = (theta, theta'), dy = (theta', theta'').
  void slope(const Vector& y, Vector& dy) const;

  std::vector<Link> links_;
  Vec3 anchor_ = Vec3::Zero();  // world [m]
  Vec3 e1_, e2_, axis_;         // the plane, and the hinges' axis
  Vec3 gravity_ = Vec3::Zero();
  Vector y_;
  Extrapolation integrator_{1e-11};
};

}  // namespace substep
