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

void move_contact(const Block& start, const Motion& a, const Motion& b, Block& moved,
                  const RowRange& rows) {
  moved.arm_a = a.R * start.arm_a;
  moved.rho = moved_rho(start, a, b);
  const Vec3 d = b.R.transpose() * moved.rho - start.rho;
  const Vec3 Hd = start.H * d;
  moved.phi[0] = gained_gap(start, d, Hd);
  moved.n = b.R * (start.n + Hd).normalized();
  // The common contact point keeps its offset along the normal from p.
  const Vec3 along = (start.r_a - start.arm_a).dot(start.n) * moved.n;
  moved.r_a = moved.arm_a + along;
  moved.r_b = moved.rho + along;
  const int end = std::min(start.rows, rows.first + rows.count);
  if (end > 1) {
    // Sliding of the material contact points along the initial tangents.
    const Vec3 slid =
        (a.dx - b.dx) + ((a.R * start.r_a - start.r_a) - (b.R * start.r_b - start.r_b));
    moved.phi[1] = start.t1.dot(slid);
    moved.phi[2] = start.t2.dot(slid);
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

double moved_gap(const Block& start, const Motion& a, const Motion& b) {
  const Vec3 d = b.R.transpose() * moved_rho(start, a, b) - start.rho;
  return gained_gap(start, d, start.H * d);
}

}  // namespace substep
