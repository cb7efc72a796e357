#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/lab/step_rules.hpp"
#include "core/math/types.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// One group of bodies that joints connect, linearised about a state with the constraint forces
/// frozen:
///   M q'' + D q' + (K_g + K_s + K_d) q = 0
/// in coordinates q that leave its joints closed, but for those so soft that a frame nearly
/// resolves them. M includes armatures. K_g is the geometric stiffness, the resisting part -K of
/// Eq. 1, symmetrised; K_s that of these joints, K_d and D those of drives and springs. Contacts,
/// limits, motors and dry friction have no part in it but by the forces of joints: motors and dry
/// friction exert what they can of what holds their coordinate, limits that are closed push. Terms
/// by velocities, gyroscopic and centrifugal ones, are left out.
class LinearModel {
 public:
  /// The groups of a scene. Joint forces are those that accelerate it from this state; in redundant
  /// joints, the smallest. Groups with more bodies than kMostBodies are left out. Empty for a scene
  /// that cannot run.
  static std::vector<LinearModel> of(const Scene& scene, const State& state);
  static constexpr int kMostBodies = 120;

  struct DriveTerm {
    int joint = -1;              // index into Scene::joints
    Eigen::VectorXd coordinate;  // its row in q
    double inertia = 0.0;        // 1/(J M^-1 J^T), armatures and joints included [kg m^2 or kg]
    double stiffness = 0.0;      // [N m/rad or N/m]
    double damping = 0.0;        // [N m s/rad or N s/m]
    bool passive = false;        // a spring, not a drive
  };
  /// What a mode consists of.
  struct Share {
    int index = -1;      // of a body or a joint
    double share = 0.0;  // [-]
  };

  [[nodiscard]] const std::vector<int>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  /// Degrees of freedom.
  [[nodiscard]] Eigen::Index size() const { return mass_.rows(); }
  /// Rows of rigid joints that others imply.
  [[nodiscard]] int redundant() const { return redundant_; }
  [[nodiscard]] const Eigen::MatrixXd& mass() const { return mass_; }
  [[nodiscard]] const Eigen::MatrixXd& geometric() const { return geometric_; }
  [[nodiscard]] const Eigen::MatrixXd& springs() const { return springs_; }
  [[nodiscard]] const std::vector<DriveTerm>& drives() const { return drives_; }
  /// r of Eq. 9 with these forces, and the body that determines it [1/s^2].
  [[nodiscard]] double r() const { return r_; }
  [[nodiscard]] int r_body() const { return r_body_; }
  /// Largest force of a joint with rigid rows [N].
  [[nodiscard]] double largest_force() const { return largest_force_; }

  /// Shares of the bodies in the kinetic energy of a mode, the largest first. They sum to 1 without
  /// armatures.
  [[nodiscard]] std::vector<Share> bodies_of(const Eigen::VectorXd& mode) const;
  /// Shares of the joints in its geometric stiffness, the largest first; those of all joints sum to
  /// 1. Empty if it does not resist. The limit 2/w changes by half as much, relatively, as the
  /// force of a joint times its share.
  [[nodiscard]] std::vector<Share> joints_of(const Eigen::VectorXd& mode) const;
  /// d(mass of the mode)/d(armature) of each hinge and slide of the group, the largest first.
  [[nodiscard]] std::vector<Share> coordinates_of(const Eigen::VectorXd& mode) const;

 private:
  struct JointTerm {
    int joint = -1;
    int a = -1;  // places in bodies_, -1: none
    int b = -1;
    Mat6 blocks[2][2];  // -K between a and b
  };
  struct CoordinateTerm {
    int joint = -1;
    Eigen::VectorXd coordinate;
  };
  class Builder;

  std::vector<int> bodies_;
  std::vector<int> joints_;
  Eigen::MatrixXd basis_;      // displacements of the bodies, six each, world [m, rad]
  Eigen::MatrixXd body_mass_;  // M of each body, 6 x 6 blocks side by side
  Eigen::MatrixXd mass_;
  Eigen::MatrixXd geometric_;
  Eigen::MatrixXd springs_;
  std::vector<DriveTerm> drives_;
  std::vector<CoordinateTerm> coordinates_;
  std::vector<JointTerm> terms_;
  int redundant_ = 0;
  double r_ = 0.0;
  int r_body_ = -1;
  double largest_force_ = 0.0;
};

}  // namespace substep
