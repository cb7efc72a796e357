#pragma once

#include "core/constraints/block.hpp"
#include "core/solver/symmetric6.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Eliminates a body together with its single joint, a ball joint or a hinge, to its parent or the
/// world, in closed form and without inverting the body's inertia; see the derivation in
/// articulated_joint.cpp. The body's quantities are about the pivot, the parent's about the
/// parent's reference point: its own pivot if it is articulated, else its centre.
class ArticulatedJoint {
 public:
  /// The largest number of rows of such a joint.
  static constexpr int kMostRows = 5;
  /// Whether it has this form: the rows of a ball joint or of a hinge.
  [[nodiscard]] static bool handles(const Block& block) {
    return block.has_point_rows && (block.rows == 3 || block.rows == kMostRows);
  }

  /// Reads the joint's data for a sub-step. @param child_is_a which side of the block is eliminated
  /// @param reference the parent's pivot from its centre [m], nullptr for the centre
  /// @param u_star array of all bodies; a pointer, because WebAssembly passes spans through memory
  void read(const Block& joint, bool child_is_a, const Vec6* u_star, const double* reference);

  /// @param W Mt^-1 of the child  @param carried contribution of the child's own children, about
  /// its pivot; only the upper half is read
  void eliminate(const InverseMass& W, const Square6& carried);
  /// The same for the contribution of a single articulated joint.
  void eliminate(const InverseMass& W, const ArticulatedJoint& carried);
  /// Contribution to the parent, about its reference point. @param out upper half
  void left(Square6& out) const { shift(P_, to_parent_, out); }

  /// Clears the accumulated momentum.
  void rest() {
    for (double& g : handed_) g = 0.0;
  }
  /// @param g_centre momentum of the child about its centre [N s, N m s], nullptr for none
  /// @param g_parent momentum of the parent, accumulated; nullptr for the world
  void forward(const double* g_centre, double* g_parent);

  /// @param v_parent change of the parent's velocity, nullptr for the world
  /// @param v_centre out: the child's
  void backward(const double* v_parent, double* v_centre);
  /// @param v_parent as passed to backward()  @param joint as passed to read(); its impulse is set
  void find_impulse(const double* v_parent, Block& joint) const;

  [[nodiscard]] const double* pivot() const { return r_; }
  /// Momentum accumulated from articulated children, about the pivot, until forward() uses it.
  [[nodiscard]] double* momentum() { return handed_; }
  /// Change of the child's velocity at the pivot.
  [[nodiscard]] const double* velocity() const { return v_; }

 private:
  /// A ball joint leaves three rotations free, a hinge one.
  static constexpr int n_free(int rows) { return rows == 5 ? 1 : 3; }
  // Inlined, to keep the inertia in registers.
  [[gnu::always_inline]] inline void eliminate_from(const InverseMass& W, const Square6& carried);
  template <int rows>
  [[gnu::always_inline]] inline void eliminate_rows(Symmetric6& A);
  template <int rows, bool exact>
  void forward_rows(const double* g_centre, double* g_parent);
  template <int rows, bool exact>
  void backward_rows(const double* v_parent, double* v_centre);
  void at_pivot(const double* v_parent, double (&v)[6]) const;
  void pass_velocity(const double* v_parent, const double (&v)[6], double (&R)[6]) const;

  /// A free rotation axis of the joint.
  struct Free {
    double f[3];
    Pairs6 column;    // A f at its elimination
    double inverse;   // 1/(f A f)
    double momentum;  // f g
  };

  int rows_;
  bool exact_;           // no row has softness
  double sign_;          // +1 if the child is the block's a, else -1
  double r_[3];          // pivot from the child's centre [m]
  double to_parent_[3];  // the parent's reference point from the pivot [m]
  double d_[6];  // exact: E w, with w = J u* + bias of the child minus the parent [m/s, rad/s]
  Free free_[3];
  Rows6 P_;  // the child's contribution to the parent, at the pivot
  double handed_[6];
  double g_[6];  // momentum passed to the parent, at the pivot
  double v_[6];
  // Only with softness:
  double e_[2][3];       // hinge: across the axis, dual to the two angular rows
  double w_[kMostRows];  // [m/s, rad/s]
  double softness_[kMostRows];
};

}  // namespace substep
