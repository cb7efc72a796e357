#include "core/constraints/moved_rows.hpp"

#include <algorithm>

namespace substep {
namespace {

void move_pin(const Block& start, const Motion& a, const Motion& b, Block& moved) {
  moved.r_a = a.R * start.r_a;
  moved.r_b = b.R * start.r_b;
  const Vec3 phi = (a.dx - b.dx) + ((moved.r_a - start.r_a) - (moved.r_b - start.r_b));
  for (int i = 0; i < 3; ++i) moved.phi[i] = phi[i];
}

void move_hinge_axis(const Block& start, const Motion& a, const Motion& b, Block& moved) {
  moved.axis = a.R * start.axis;
  moved.v1 = b.R * start.v1;
  moved.v2 = b.R * start.v2;
  for (int k = 0; k < 2; ++k) {
    const Vec3& v = k == 0 ? moved.v1 : moved.v2;
    const Vec3& v_start = k == 0 ? start.v1 : start.v2;
    const Vec3 J = moved.axis.cross(v);
    moved.phi[3 + k] = moved.axis.dot(v) - start.axis.dot(v_start);
    for (int j = 0; j < 3; ++j) moved.J_a[3 + k][3 + j] = J[j];
  }
}

// Where the point p of a that touches is then, from the centre of b.
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
  // The point that both surfaces share keeps its place along the normal from p.
  const Vec3 along = (start.r_a - start.arm_a).dot(start.n) * moved.n;
  moved.r_a = moved.arm_a + along;
  moved.r_b = moved.rho + along;
  const int end = std::min(start.rows, rows.first + rows.count);
  if (end > 1) {
    // How far the material points that touch have slid, along the tangents of the start.
    const Vec3 slid =
        (a.dx - b.dx) + ((a.R * start.r_a - start.r_a) - (b.R * start.r_b - start.r_b));
    moved.phi[1] = start.t1.dot(slid);
    moved.phi[2] = start.t2.dot(slid);
    const Vec3 t = b.R * start.t1;
    moved.t1 = (t - moved.n * moved.n.dot(t)).normalized();
    moved.t2 = moved.n.cross(moved.t1);
  }
  for (int row = rows.first; row < end; ++row) {
    const Vec3& direction = row == 0 ? moved.n : row == 1 ? moved.t1 : moved.t2;
    const Vec3 A = moved.r_a.cross(direction);
    const Vec3 B = moved.r_b.cross(direction);
    for (int j = 0; j < 3; ++j) {
      moved.J_a[row][j] = direction[j];
      moved.J_b[row][j] = -direction[j];
      moved.J_a[row][3 + j] = A[j];
      moved.J_b[row][3 + j] = -B[j];
    }
  }
}

}  // namespace

void move_rows(const Block& start, const Motion& a, const Motion& b, Block& moved, RowRange rows) {
  if (start.is_contact()) return move_contact(start, a, b, moved, rows);
  if (rows.first < 3) move_pin(start, a, b, moved);
  if (rows.first + rows.count > 3 && start.kind == BlockKind::kHinge) {
    move_hinge_axis(start, a, b, moved);
  }
}

void moved_errors(const Block& start, const Motion& a, const Motion& b, double* phi) {
  const Vec3 r_a = a.R * start.r_a;
  const Vec3 r_b = b.R * start.r_b;
  const Vec3 gap = (a.dx - b.dx) + ((r_a - start.r_a) - (r_b - start.r_b));
  for (int i = 0; i < 3; ++i) phi[i] = gap[i];
  if (start.kind != BlockKind::kHinge) return;
  const Vec3 axis = a.R * start.axis;
  phi[3] = axis.dot(b.R * start.v1) - start.axis.dot(start.v1);
  phi[4] = axis.dot(b.R * start.v2) - start.axis.dot(start.v2);
}

double moved_gap(const Block& start, const Motion& a, const Motion& b) {
  const Vec3 d = b.R.transpose() * moved_rho(start, a, b) - start.rho;
  return gained_gap(start, d, start.H * d);
}

std::int64_t move_flops(const Block& block, int rows) {
  const std::int64_t bodies = (block.a >= 0 ? 1 : 0) + (block.b >= 0 ? 1 : 0);
  constexpr std::int64_t kRow = 15;   // phi and J of one row at other poses
  constexpr std::int64_t kBody = 60;  // its turn
  return kRow * rows + kBody * bodies;
}

}  // namespace substep
