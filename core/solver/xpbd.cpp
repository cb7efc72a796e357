#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constraints/moved_rows.hpp"
#include "core/math/turn.hpp"
#include "core/solver/cost_model.hpp"
#include "core/solver/small_steps.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Extended position-based dynamics of rigid bodies (Mueller et al. 2020, "Detailed rigid body
/// simulation with extended position based dynamics"): bodies first move without constraints, then
/// joints and contacts are corrected one after the other, each along its current error. Velocities
/// are derived from the displacement and represent the poses during the sweeps: (x+ - x)/dt and the
/// Cayley vector of the rotation. A fixed number of sweeps, Settings::iterations; the authors
/// recommend one, with many sub-steps.
///
/// With compliance, a correction is along the residual, error plus compliance term, rather than the
/// error alone: identical in the first sweep, and further sweeps converge to a zero residual.
/// Friction is bounded in the position correction instead of the authors' velocity pass, and
/// inertias keep their axes at the start of the sub-step.
class Xpbd final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks, bool loops) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  /// Corrects the error of some rows of a block with one impulse along it. @param bound symmetric
  /// bound on the impulse of a single row, or on the length of both friction impulses
  void correct(const System& system, std::size_t block, RowRange rows, double bound);
  /// True if a contact without impulse stays without one.
  [[nodiscard]] bool stays_open(const System& system, const Block& block) const;

  std::vector<Block> moved_;  // the blocks at the poses of their last visits
  Motions motions_;           // displacements so far
};

namespace {

/// Gradient of the error along a direction in row space, for one body.
Vec6 gradient(const Block& block, RowRange rows, bool of_a, const double* direction) {
  Vec6 g = Vec6::Zero();
  for (int i = 0; i < rows.count; ++i) g += direction[i] * gradient(block, rows.first + i, of_a);
  return g;
}

/// Advances the motion of a body by du dt; u is the resulting velocity for integrate().
void push(const Vec6& du, double dt, Vec6& u) {
  u.head<3>() += du.head<3>();
  u.tail<3>() = (2.0 / dt) * turn_after(0.5 * dt * u.tail<3>(), 0.5 * dt * du.tail<3>());
}

// The residual of rows, e = bias + phi/dt + softness * impulse. @param moved the rows as moved
// @param direction e of length 1; unchanged for a single row
// @return the length of e; e itself for a single row
double residual(const Block& block, const Block& moved, RowRange rows, double dt,
                double* direction) {
  const double softness = block.softness[rows.first];
  double length = 0.0;
  for (int i = 0; i < rows.count; ++i) {
    const int row = rows.first + i;
    const double e = block.bias[row] + moved.phi[row] / dt + softness * block.impulse[row];
    if (rows.count == 1) return e;
    direction[i] = e;
    length += e * e;
  }
  length = std::sqrt(length);
  if (length == 0.0) return 0.0;
  for (int i = 0; i < rows.count; ++i) direction[i] /= length;
  return length;
}

}  // namespace

void Xpbd::reserve(std::size_t bodies, std::size_t blocks, bool /*loops*/) {
  moved_.reserve(blocks);
  motions_.reserve(bodies);
}

bool Xpbd::stays_open(const System& system, const Block& block) const {
  if (block.impulse[0] != 0.0) return false;
  double gained[kMaxRows];
  if (block.is_contact()) {
    gained[0] = moved_gap(block, motions_.of(block.a), motions_.of(block.b));
  } else {
    moved_errors(block, motions_.of(block.a), motions_.of(block.b), gained);
  }
  return block.bias[0] + gained[0] / system.dt >= 0.0;
}

// The residual has length c and direction d; an impulse p along d changes it along d by
//   (w + softness) p,   w = g M^-1 g^T,   g = d^T J,
// so p = -c/(w + softness). The authors use the error without softness: identical in the first
// sweep, but for soft joints further sweeps may stall where the two parts are perpendicular.
void Xpbd::correct(const System& system, std::size_t at, RowRange rows, double bound) {
  Block& block = system.blocks[at];
  Block& moved = moved_[at];
  move_rows(block, motions_.of(block.a), motions_.of(block.b), moved, rows);

  double direction[kMaxRows] = {1.0};
  const double left = residual(block, moved, rows, system.dt, direction);
  if (left == 0.0 && rows.count > 1) return;

  double w = block.softness[rows.first];
  Vec6 du_a = Vec6::Zero();
  Vec6 du_b = Vec6::Zero();
  const auto respond = [&](bool of_a, Vec6& du) {  // M^-1 g^T and w of one side
    const int body = of_a ? block.a : block.b;
    if (body < 0) return 0.0;
    const Vec6 g = gradient(moved, rows, of_a, direction);
    const InverseMass& mass = system.inverse_mass[index(body)];
    du << mass.linear * g.head<3>(), mass.angular * g.tail<3>();
    return g.dot(du);
  };
  w += respond(true, du_a);
  w += respond(false, du_b);
  double p = -left / w;
  if (block.is_bounded() && rows.count == 1) {
    const double before = block.impulse[rows.first];
    const double lowest = rows.first == 0 ? block.lo : -bound;
    const double highest = rows.first == 0 ? block.hi : bound;
    p = std::min(highest, std::max(lowest, before + p)) - before;
  }
  if (p == 0.0) return;
  if (block.is_contact() && rows.count == 2) {  // cone: the length of the sum is bounded
    double sum[2];
    for (int i = 0; i < 2; ++i) sum[i] = block.impulse[rows.first + i] + p * direction[i];
    const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1]);
    const double scale = length > bound ? bound / length : 1.0;
    for (int i = 0; i < 2; ++i) {
      direction[i] = scale * sum[i] - block.impulse[rows.first + i];
    }
    p = 1.0;
    respond(true, du_a);
    respond(false, du_b);
  }
  for (int i = 0; i < rows.count; ++i) block.impulse[rows.first + i] += p * direction[i];
  const auto move = [&](int body, const Vec6& du) {
    if (body < 0) return;
    const auto i = index(body);
    push(p * du, system.dt, system.u[i]);
    motions_[i] = motion(system.u[i], system.dt);
  };
  move(block.a, du_a);
  move(block.b, du_b);
}

SolveReport Xpbd::find_velocities(const System& system, const Settings& settings) {
  const bool cone = settings.friction_cone == FrictionCone::kCone;
  SolveReport report;
  const int iterations = iterations_of(settings, system.frame_share);
  report.iterations = iterations;
  double most = 0.0;  // upper bound: every row in every sweep
  for (const Block& block : system.blocks) {
    std::int64_t sweep = block.rows * correction_flops(block, 1);
    if (!block.is_bounded()) {
      const int angles = block.rows - block.position_rows;
      sweep = correction_flops(block, block.position_rows) +
              (angles > 0 ? correction_flops(block, angles) : 0);
    }
    most += static_cast<double>(iterations) * static_cast<double>(sweep);
  }
  if (most > system.limits.work) {
    return {.status = SolveStatus::kOverLimits, .work_needed = most};
  }
  for (Block& block : system.blocks) std::fill(block.impulse, block.impulse + kMaxRows, 0.0);
  moved_.assign(system.blocks.begin(), system.blocks.end());
  motions_.set(system.u, system.dt);
  const auto visit = [&](std::size_t i, RowRange rows, double bound = kUnbounded) {
    correct(system, i, rows, bound);
    report.row_updates += rows.count;
    report.flops += correction_flops(system.blocks[i], rows.count);
  };
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      const Block& block = system.blocks[i];
      if (block.is_bounded()) {
        if (block.is_unilateral() && stays_open(system, block)) {
          ++report.row_updates;
          report.flops += move_flops(block, 1);
        } else {
          visit(i, {0, 1});
        }
        if (cone && block.rows == 3) {
          const double bound = block.mu * block.impulse[0];
          const bool rubs = block.impulse[1] != 0.0 || block.impulse[2] != 0.0;
          if (bound > 0.0 || rubs) visit(i, {1, 2}, bound);
          point_cone(system.blocks[i], block.impulse[1], block.impulse[2]);
          continue;
        }
        for (int row = 1; row < block.rows; ++row) {
          const double bound = block.mu * block.impulse[0];
          if (bound > 0.0 || block.impulse[row] != 0.0) visit(i, {row, 1}, bound);
        }
        continue;
      }
      const int positions = block.position_rows;
      if (positions > 0) visit(i, {0, positions});
      if (block.rows > positions) visit(i, {positions, block.rows - positions});
    }
  }
  return report;
}

std::unique_ptr<Solver> make_xpbd() { return std::make_unique<Xpbd>(); }

}  // namespace substep
