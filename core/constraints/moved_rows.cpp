#include "core/constraints/moved_rows.hpp"

#include <algorithm>

#include "core/constraints/joint_rows.hpp"

namespace substep {
namespace {

// Position of a's contact point p after the motion, from the centre of b.
Vec3 moved_rho(const Block& start, const Motion& a, const Motion& b) {
  return start.rho + (a.dx - b.dx) + (a.R * start.arm_a - start.arm_a);
}

// The gap is D(p) - radius with D fixed in b and p fixed in a. Seen from b, p moves by d; then
// D = D_0 + n . d + d . H d / 2 and grad D = n + H d.
double gained_gap(const Block& start, const Vec3& d, const Vec3& Hd) {
  return start.n.dot(d) + 0.5 * d.dot(Hd);
}

// A contact point after the motion, world but for d and Hd.
struct MovedPoint {
  Vec3 d;      // from where p was, in the frame of b [m]
  Vec3 Hd;     // change of the normal, in the frame of b [-]
  Vec3 n;      // normal
  Vec3 arm_a;  // as in Block [m]
  Vec3 rho;
  Vec3 r_a;
  Vec3 r_b;
};

MovedPoint move_point(const Block& start, const Motion& a, const Motion& b) {
  MovedPoint moved;
  moved.arm_a = a.R * start.arm_a;
  moved.rho = moved_rho(start, a, b);
  moved.d = b.R.transpose() * moved.rho - start.rho;
  moved.Hd = start.H * moved.d;
  moved.n = b.R * (start.n + moved.Hd).normalized();
  // The common contact point keeps its offset along the normal from p.
  const Vec3 along = (start.r_a - start.arm_a).dot(start.n) * moved.n;
  moved.r_a = moved.arm_a + along;
  moved.r_b = moved.rho + along;
  return moved;
}

// Displacement [m] by a rotation of the point whose arm is the mean of two. With c = dt omega of
// integrate()'s Cayley map,
//   R r - r = c x (R r + r)/2.
// It is therefore R r - r for a point of the body, whose arm rotates with it, and dt omega x r for
// a constant arm.
Vec3 turned_about_middle(const Mat3& R, const Vec3& r, const Vec3& r_moved) {
  constexpr double kLeast = 1e-12;  // near half a turn
  const Vec3 twice_sine{R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};
  const Vec3 c = 2.0 / std::max(1.0 + R.trace(), kLeast) * twice_sine;
  return c.cross(0.5 * (r + r_moved));
}

// Sliding distance of the points that touch in the middle of the motion [m]. Those that touch at
// its start leave the tangential plane if a ball rolls and spins about the normal.
Vec3 slid(const Block& start, const Motion& a, const Motion& b, const MovedPoint& moved) {
  return (a.dx - b.dx) + (turned_about_middle(a.R, start.r_a, moved.r_a) -
                          turned_about_middle(b.R, start.r_b, moved.r_b));
}

void move_contact(const Block& start, const Motion& a, const Motion& b, Block& moved,
                  const RowRange& rows) {
  const MovedPoint point = move_point(start, a, b);
  moved.arm_a = point.arm_a;
  moved.rho = point.rho;
  moved.phi[0] = gained_gap(start, point.d, point.Hd);
  moved.n = point.n;
  moved.r_a = point.r_a;
  moved.r_b = point.r_b;
  const int end = std::min(start.rows, rows.first + rows.count);
  if (end > 1) {
    const Vec3 by = slid(start, a, b, point);
    moved.phi[1] = start.t1.dot(by);
    moved.phi[2] = start.t2.dot(by);
    const Vec3 t = b.R * start.t1;
    moved.t1 = (t - moved.n * moved.n.dot(t)).normalized();
    moved.t2 = moved.n.cross(moved.t1);
  }
  for (int row = rows.first; row < end; ++row) {
    set_row(moved, row, row == 0 ? moved.n : row == 1 ? moved.t1 : moved.t2);
  }
}

}  // namespace

void move_rows(const Block& start, const Motion& a, const Motion& b, Block& moved, RowRange rows) {
  if (start.is_contact()) return move_contact(start, a, b, moved, rows);
  with_joint_rows(start.kind, [&](auto joint) { joint.move(start, a, b, rows, moved); });
}

void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
  with_joint_rows(start.kind, [&](auto joint) { joint.moved_errors(start, a, b, phi); });
}

void moved_sliding(const Block& start, const Motion& a, const Motion& b, double* by) {
  const Vec3 distance = slid(start, a, b, move_point(start, a, b));
  by[0] = start.t1.dot(distance);
  by[1] = start.t2.dot(distance);
}

double moved_gap(const Block& start, const Motion& a, const Motion& b) {
  const Vec3 d = b.R.transpose() * moved_rho(start, a, b) - start.rho;
  return gained_gap(start, d, start.H * d);
}

}  // namespace substep
