#include "core/solver/system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/solver/body_products.hpp"

namespace substep {

namespace {

/// Adds J^T x of one side to a momentum; for a pin x and r x x, row by row. @param sign side of a
/// block with point rows: +1 for a, -1 for b  @param J of any other block
[[gnu::always_inline]] inline void add_push(const Block& block, const double (&J)[kMaxRows][6],
                                            double sign, const Vec3& r, const double* x, Vec6& g) {
  if (!block.has_point_rows) {
    for (int row = 0; row < block.rows; ++row) {
      for (int j = 0; j < 6; ++j) g[j] += J[row][j] * x[row];
    }
    return;
  }
  const double push[3] = {sign * x[0], sign * x[1], sign * x[2]};
  for (int i = 0; i < 3; ++i) g[i] += push[i];
  g[3] = (g[3] - r[2] * push[1]) + r[1] * push[2];
  g[4] = (g[4] + r[2] * push[0]) - r[0] * push[2];
  g[5] = (g[5] - r[1] * push[0]) + r[0] * push[1];
  for (int row = 3; row < block.rows; ++row) {
    const double f = sign * x[row];
    for (int j = 3; j < 6; ++j) g[j] += block.J_a[row][j] * f;
  }
}

void kick(const Vec6& f, const InverseMass& mass, Vec6& u) {
  for (int i = 0; i < 3; ++i) {
    u[i] += mass.linear * f[i];
    u[3 + i] += mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

/// Adds J u of one side to the speeds of the rows.
[[gnu::always_inline]] inline void add_speeds(const Block& block, const double (&J)[kMaxRows][6],
                                              double sign, const Vec3& r, const Vec6& u,
                                              double* speed) {
  if (!block.has_point_rows) {
    for (int row = 0; row < block.rows; ++row) speed[row] += dot6(J[row], u.data());
    return;
  }
  const Vec3 turning = u.tail<3>().cross(r);
  for (int row = 0; row < 3; ++row) {
    speed[row] += sign * turning[row];
    speed[row] += sign * u[row];
  }
  for (int row = 3; row < block.rows; ++row) {
    const double* axis = block.J_a[row] + 3;
    speed[row] += sign * (axis[0] * u[3] + axis[1] * u[4] + axis[2] * u[5]);
  }
}

/// The mean of the sliding before and after as a bias and a softness of row 2,
///   beta s_2 + s_2+ + (1 + beta) |s|/(mu x_n) x_2 = 0,
/// with beta = 1 where the forces hardly change the sliding, and 0 where it begins: there the mean
/// would let it swing. @param before, after row speeds in the tangents before they turn by (c, s)
void mean_sliding(const double* before, const double* after, double c, double s, Block& block) {
  const double square = before[1] * before[1] + before[2] * before[2];
  const double gained[] = {after[1] - before[1], after[2] - before[2]};
  const double changed = gained[0] * gained[0] + gained[1] * gained[1];
  if (square == 0.0) return;
  const double beta = square / (square + changed);
  block.sliding = (1.0 + beta) * std::sqrt(square);
  block.across = beta * (c * before[2] - s * before[1]);
  block.bias[2] += block.across;
  block.softness[2] = block.softness[1];  // until soften_across()
}

/// Sliding slower than this has no direction [m/s]: friction stops it in a small part of the
/// sub-step. In bodies at rest it is rounding error, and tangents that followed it would change the
/// forces in every sub-step. The normal speed alone is no measure: it is zero between bodies that
/// fall together.
double slowest_sliding(const System& system, const Block& contact, double normal_speed) {
  constexpr double kOfForces = 1e-5;  // of the speed that forces give in the sub-step [-]
  constexpr double kOfNormal = 1e-6;  // of the normal speed [-]
  double by_forces = 0.0;
  for (const int body : {contact.a, contact.b}) {
    if (body < 0 || system.u_before.empty()) continue;
    const Vec6 change = system.u[index(body)] - system.u_before[index(body)];
    by_forces += change.head<3>().norm();
  }
  return std::max(kOfForces * by_forces, kOfNormal * std::abs(normal_speed));
}

}  // namespace

double mobility_on(const Block& block, int row, bool of_a,
                   std::span<const InverseMass> inverse_mass) {
  const int body = of_a ? block.a : block.b;
  if (body < 0) return 0.0;
  const InverseMass& W = inverse_mass[index(body)];
  const Vec6 J = gradient(block, row, of_a);
  const Vec3 turn = J.tail<3>();
  return W.linear * J.head<3>().squaredNorm() + turn.dot(W.angular * turn);
}

// Sums stay in registers: `speed` may alias.
void row_speeds(const Block& block, const Vec6* a, const Vec6* b, double* speed) {
  if (block.rows == 1) {  // most contacts
    double sum = 0.0;
    if (a != nullptr) sum += dot6(block.J_a[0], a->data());
    if (b != nullptr) sum += dot6(block.J_b[0], b->data());
    speed[0] = sum;
    return;
  }
  double sum[kMaxRows] = {};
  if (a != nullptr) add_speeds(block, block.J_a, 1.0, block.r_a, *a, sum);
  if (b != nullptr) add_speeds(block, block.J_b, -1.0, block.r_b, *b, sum);
  for (int row = 0; row < block.rows; ++row) speed[row] = sum[row];
}

void row_speeds(const Block& block, std::span<const Vec6> u, double* speed) {
  row_speeds(block, block.a < 0 ? nullptr : &u[index(block.a)],
             block.b < 0 ? nullptr : &u[index(block.b)], speed);
}

void push(const Block& block, const double* x, Vec6* a, Vec6* b) {
  if (a != nullptr) add_push(block, block.J_a, 1.0, block.r_a, x, *a);
  if (b != nullptr) add_push(block, block.J_b, -1.0, block.r_b, x, *b);
}

void apply_impulse(const Block& block, const double* impulse,
                   std::span<const InverseMass> inverse_mass, std::span<Vec6> u) {
  Vec6 on_a = Vec6::Zero();
  Vec6 on_b = Vec6::Zero();
  push(block, impulse, &on_a, &on_b);
  if (block.a >= 0) {
    const auto a = index(block.a);
    kick(on_a, inverse_mass[a], u[a]);
  }
  if (block.b >= 0) {
    const auto b = index(block.b);
    kick(on_b, inverse_mass[b], u[b]);
  }
}

double friction_bound(const Block& block, int row, double normal) {
  return block.mu * std::max(0.0, normal) * block.share[row - 1];
}

bool sticks(const Block& contact) {
  constexpr double kWithin = 1.0 - 1e-9;  // of the bound: at it, a force is rounded
  if (contact.rows != 3) return false;
  const auto at_bound = [&](int row) { return std::abs(contact.active_set[row]) == 1; };
  if (at_bound(1) || at_bound(2)) return false;  // BPP: the bound may be that of an earlier pass
  const double bound = kWithin * contact.mu * contact.impulse[0];
  const double square =
      contact.impulse[1] * contact.impulse[1] + contact.impulse[2] * contact.impulse[2];
  return bound > 0.0 && square < bound * bound;
}

void point_cone(Block& block, double along_t1, double along_t2) {
  const double length = std::sqrt(along_t1 * along_t1 + along_t2 * along_t2);
  const double even = std::sqrt(0.5);
  block.share[0] = length > 0.0 ? std::abs(along_t1) / length : even;
  block.share[1] = length > 0.0 ? std::abs(along_t2) / length : even;
}

void align_tangents(const System& system) {
  const bool knows_before = !system.u_sliding.empty();
  for (Block& block : system.blocks) {
    if (block.rows != 3 || !block.is_contact()) continue;
    block.share[0] = block.share[1] = 1.0;  // sweeps of a fallback may have changed it
    block.sliding = block.across = 0.0;
    double after[kMaxRows];
    double before[kMaxRows];
    row_speeds(block, system.u, after);
    if (knows_before) {
      row_speeds(block, system.u_sliding, before);
    } else {
      std::copy_n(after, block.rows, before);
    }
    const double mean[] = {0.5 * (before[1] + after[1]), 0.5 * (before[2] + after[2])};
    const double length = std::sqrt(mean[0] * mean[0] + mean[1] * mean[1]);
    if (!(length > slowest_sliding(system, block, after[0]))) continue;
    const double c = mean[0] / length;
    const double s = mean[1] / length;
    const auto turn = [&](double& along_t1, double& along_t2) {
      const double first = c * along_t1 + s * along_t2;
      along_t2 = c * along_t2 - s * along_t1;
      along_t1 = first;
    };
    for (int j = 0; j < 6; ++j) {
      turn(block.J_a[1][j], block.J_a[2][j]);
      turn(block.J_b[1][j], block.J_b[2][j]);
    }
    for (int j = 0; j < 3; ++j) turn(block.t1[j], block.t2[j]);
    turn(block.bias[1], block.bias[2]);
    turn(block.given[1], block.given[2]);
    if (knows_before && !sticks(block)) mean_sliding(before, after, c, s, block);
  }
}

bool soften_across(Block& contact) {
  const double bound = contact.mu * std::max(0.0, contact.impulse[0]);
  const double yields = bound > 0.0 ? contact.sliding / bound : 0.0;
  const bool is_softened = contact.softness[2] != contact.softness[1];
  if (!(yields > 0.0) || !std::isfinite(yields) || is_softened) return false;
  contact.softness[2] += yields;
  return true;
}

double lcp_residual(const System& system) {
  double worst = 0.0;
  double speed[kMaxRows];
  for (const Block& block : system.blocks) {
    row_speeds(block, system.u, speed);
    for (int row = 0; row < block.rows; ++row) {
      double lo = -kUnbounded;
      double hi = kUnbounded;
      if (block.is_bounded()) {
        hi = row == 0 ? block.hi : friction_bound(block, row, block.impulse[0]);
        lo = row == 0 ? block.lo : -hi;
      }
      const double x = block.impulse[row];
      const double w = speed[row] + block.softness[row] * x + block.bias[row];
      // The natural residual: zero if and only if w and x are complementary.
      const double projected = std::min(hi, std::max(lo, x - w));
      worst = std::max(worst, std::abs(x - projected));
    }
  }
  return worst;
}

}  // namespace substep
