#pragma once

#include "core/constraints/block.hpp"
#include "core/constraints/joint_geometry.hpp"
#include "core/math/turn.hpp"

namespace substep {

/// The motion of a sub-step, as computed by integrate(). @param u [m/s, rad/s]  @param dt [s]
inline Motion motion(const Vec6& u, double dt) {
  return {dt * u.head<3>(), turn_matrix(0.5 * dt * u.tail<3>())};
}

/// The motions of all bodies.
class Motions {
 public:
  void reserve(std::size_t bodies) { of_.reserve(bodies); }
  /// @param u per body
  void set(std::span<const Vec6> u, double dt) {
    of_.clear();
    for (const Vec6& v : u) of_.push_back(motion(v, dt));
  }
  void resize(std::size_t bodies) { of_.resize(bodies); }
  [[nodiscard]] Motion& operator[](std::size_t body) { return of_[body]; }
  /// None for -1.
  [[nodiscard]] const Motion& of(int body) const { return body < 0 ? none_ : of_[index(body)]; }

 private:
  std::vector<Motion> of_;
  Motion none_;
};

/// phi and J of a block after its bodies have moved, for solvers that use the end of a sub-step.
/// Exact for joints and for points on faces; second order (by H) for sphere against sphere.
/// @param moved out: J, the change of phi, arms, axes, normal and tangents of the given rows; phi
/// of friction is the sliding distance. Other members are unchanged.
void move_rows(const Block& start, const Motion& a, const Motion& b, Block& moved,
               RowRange rows = {});

/// Change of phi of a joint's rows. @param phi out, one per row
void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi);

/// Sliding distances of a contact along t1 and t2, as in move_rows(). @param by out, two [m]
void moved_sliding(const Block& start, const Motion& a, const Motion& b, double* by);

/// Change of phi of a contact's normal, as in move_rows().
double moved_gap(const Block& start, const Motion& a, const Motion& b);

}  // namespace substep
