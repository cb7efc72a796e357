#pragma once

#include <optional>
#include <vector>

#include "core/lab/articulated_inertia.hpp"
#include "core/lab/extrapolation.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The exact 3D motion of trees of bodies on hinges and ball joints, in minimal coordinates, hence
/// without constraint error.
///
/// A tree hangs from the world, or its heaviest body is free. The coordinates of a body are
///   free:  position, orientation; velocity, angular velocity          6 degrees of freedom
///   ball:  orientation; angular velocity                              3
///   hinge: angle from the start; its rate                             1
/// with the orientation q_WB and all velocities of free bodies and ball joints in the world, so
/// that a body on a ball joint does not depend on its parent's orientation. q' = (0, omega) q / 2;
/// an angle theta is kept as cos(theta/2), sin(theta/2), so that nothing beyond sqrt is needed and
/// the bits are the same everywhere.
///
/// Hinges may have armatures. Accelerations come from the articulated-body algorithm
/// (articulated_inertia.hpp), O(bodies):
/// positions and velocities outwards, inertias inwards, accelerations outwards.
class JointTree {
 public:
  /// The trees of the scene, or nothing for other scenes: contact, applied forces other than
  /// gravity, a closed loop, inconsistent joints at the start, noticeable compliance or
  /// regularisation, unequal moments of inertia without the gyroscopic effect, or bodies so thin or
  /// so fast that rounding exceeds the tolerance or a frame takes seconds.
  static std::optional<JointTree> of(const Scene& scene);

  /// @param tolerance of the steps from now on, relative to 1 + |coordinate| [-]
  void set_tolerance(double tolerance) { integrator_ = Extrapolation(tolerance); }
  void advance(double seconds);
  /// One attempt at a step of the integrator, for callers that must return between steps.
  /// @param most [s] @return time advanced, 0 <= . <= most [s]
  double attempt(double most);

  /// One step as MuJoCo takes it: semi-implicit Euler in the rates of hinges and in those of ball
  /// joints relative to their parents, in their own frames. Forces by velocities are explicit.
  /// Rotations are Cayley maps. @param h [s]
  void step_semi_implicit(double h);

  /// Centre of a body of the scene, world [m].
  [[nodiscard]] Vec3 centre(int body) const;
  /// q_WB of a body of the scene.
  [[nodiscard]] Quat orientation(int body) const;
  /// Velocity of a body's centre, angular velocity, world [m/s, rad/s].
  [[nodiscard]] Vec6 velocity(int body) const;
  /// Force at the centre and torque about it with which the joint nearest to the root acts on a
  /// body, world [N, N m]; the joint's own point is not the centre. Zero for a free body.
  [[nodiscard]] Vec6 reaction(int body) const;
  [[nodiscard]] double kinetic() const;    ///< [J]
  [[nodiscard]] double potential() const;  ///< of gravity, zero at the world's origin [J]
  /// At most how far the compliances of all joints open under the weights and the forces now [m].
  [[nodiscard]] double stretch() const;
  /// Length of all arms between joints and centres [m].
  [[nodiscard]] double reach() const { return reach_; }
  /// Degrees of freedom.
  [[nodiscard]] int size() const { return degrees_; }
  /// Moving bodies.
  [[nodiscard]] int bodies() const { return static_cast<int>(nodes_.size()); }

  static constexpr double kTolerance = 1e-12;  // [-]

 private:
  using Vector = VecX;
  enum class Kind { kFree, kBall, kHinge };
  /// A moving body and the joint that leads to it from the root. Parents come first.
  struct Node {
    int body = 0;  // index into Scene::bodies
    Kind kind = Kind::kFree;
    int parent = kWorld;          // index into nodes_, or kWorld
    double mass = 0.0;            // [kg]
    Vec3 inertia = Vec3::Zero();  // principal [kg m^2]
    Vec3 r = Vec3::Zero();        // from the joint to the centre, in the body [m]
    Vec3 l = Vec3::Zero();        // from the parent's joint to this, in the parent or world [m]
    Vec3 axis = Vec3::UnitZ();    // of a hinge, in the body
    Quat at_start = Quat::Identity();  // of a hinge: orientation in the parent
    double armature = 0.0;             // of a hinge [kg m^2]
    double compliance = 0.0;           // [m/N]
    double angular_compliance = 0.0;   // [rad/(N m)]
    Eigen::Index q = 0;                // where its positions begin in y
    Eigen::Index u = 0;                // where its velocities begin in y
  };
  /// Where a body is and how it moves, world.
  struct Motion {
    Quat q_WB = Quat::Identity();
    Vec3 p = Vec3::Zero();            // its joint [m]
    Vec3 v = Vec3::Zero();            // of p [m/s]
    Vec3 omega = Vec3::Zero();        // [rad/s]
    Vec3 r = Vec3::Zero();            // from p to the centre [m]
    Vec3 l = Vec3::Zero();            // from the parent's p [m]
    Vec3 h = Vec3::Zero();            // axis of a hinge
    Mat3 I = Mat3::Zero();            // about the centre [kg m^2]
    Vec3 alpha_bias = Vec3::Zero();   // omega_parent x h theta' [rad/s^2]
    Vec3 a_bias = Vec3::Zero();       // omega_parent x (omega_parent x l) [m/s^2]
    Vec3 alpha = Vec3::Zero();        // [rad/s^2]
    Vec3 a = Vec3::Zero();            // of p, less gravity [m/s^2]
    ArticulatedInertia inertia = {};  // of the body and its subtree
  };
  class Builder;  // joint_tree_build.cpp

  /// y = positions, velocities of all nodes; dy = y'.
  void slope(const Vector& y, Vector& dy);
  void move_outwards(const Vector& y);
  void collect_inertias();
  void accelerate_outwards(const Vector& y, Vector& dy);
  [[nodiscard]] const Motion& parent_of(const Node& node) const;
  [[nodiscard]] const Motion* motion_of(int body) const;  // null for a static body
  void normalise();

  std::vector<Node> nodes_;
  std::vector<Motion> motion_;                   // of nodes_, at y_ between calls
  std::vector<int> node_of_;                     // of Scene::bodies, -1 for a static one
  std::vector<std::pair<Vec3, Quat>> at_start_;  // of Scene::bodies
  Motion world_;
  Vec3 gravity_ = Vec3::Zero();
  double weight_ = 0.0;  // of all bodies [N]
  double reach_ = 0.0;   // length of all arms [m]
  int degrees_ = 0;
  Vector y_;
  Vector dy_;  // scratch
  Extrapolation integrator_{kTolerance};
};

}  // namespace substep
