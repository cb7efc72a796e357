#include "core/sim/start_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/constraints/joint_stage.hpp"
#include "core/model/budget.hpp"
#include "core/model/validate.hpp"
#include "core/sim/joint_starts.hpp"
#include "core/solver/bpp.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {
namespace {

constexpr double kClosedError = 1e-13;  // ends an iteration, of the joint's size or in rad
// Softness of a joint's anchors if only its axes are rigid, relative to 1/m: negligible impulse
// without loss of precision [-].
constexpr double kFree = 1e8;
constexpr double kMostMemory = 64.0 * kMebibyte;  // of a factor [bytes]
constexpr double kMostWork = 5e8;                 // of a start [floating-point operations]
constexpr int kMostClosing = 50;                  // Newton steps
constexpr int kMostNearing = 100;  // steps towards the least change, which converge linearly
constexpr int kMostMatching = 8;   // solves for velocities: more than one where rows are redundant

/// The rows of all joints at a state, and the solver for them.
class StartRows {
 public:
  StartRows(const Scene& scene, State& state)
      : state_(state),
        all_(whole(scene)),
        joints_(scene),
        own_(inertia_inverses(scene)),
        R_WB_(scene.bodies.size()),
        inverse_mass_(scene.bodies.size()) {
    for (const Joint& joint : scene.joints) sizes_.push_back(size_of_joint(scene, base(joint)));
    solver_.reserve(scene.bodies.size(), scene.joints.size(), false);
    update();
    for (const Block& block : blocks_.all()) {
      holds_.push_back(holding_rows(block, inverse_mass_, scene.frame));
    }
  }

  /// Recomputes the rows at the current poses.
  void update() {
    for (std::size_t i = 0; i < R_WB_.size(); ++i) R_WB_[i] = state_.q[i].toRotationMatrix();
    inverse_mass(own_, all_, R_WB_, inverse_mass_);
    blocks_.clear();
    joints_.append(all_, state_, R_WB_, blocks_);
  }

  /// Largest error of a rigid row: a gap relative to the joint's size, or a tilt [-, rad].
  [[nodiscard]] double error() const {
    double most = 0.0;
    for_holding([&](const Block& block, int row, double size) {
      const double error = std::abs(block.phi[row]) / (row < block.position_rows ? size : 1.0);
      most = error > most || std::isnan(error) ? error : most;
    });
    return most;
  }

  /// Largest J u of a rigid row [m/s, rad/s].
  [[nodiscard]] double error_of(std::span<const Vec6> u) const {
    double most = 0.0;
    double speeds[kMaxRows];
    for_holding([&](const Block& block, int row, double) {
      if (row == 0 || row == block.position_rows) row_speeds(block, u, speeds);
      const double error = std::abs(speeds[row]);
      most = error > most || std::isnan(error) ? error : most;
    });
    return most;
  }

  /// Projects u in the mass norm onto J u = -share * phi. @return false if that would exceed the
  /// limits of a start; then u is invalid
  bool solve(double share, std::vector<Vec6>& u) {
    held_.clear();
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (!holds_[i].anchors && !holds_[i].axes) continue;
      Block& block = held_.emplace_back(blocks_.all()[i]);
      if (!holds_[i].axes) block.rows = block.position_rows;
      double free = 0.0;  // [1/kg]
      for (const int body : {block.a, block.b}) {
        if (body >= 0) free += kFree * inverse_mass_[index(body)].linear;
      }
      for (int row = 0; row < block.rows; ++row) {
        const bool held = row >= block.position_rows || holds_[i].anchors;
        block.bias[row] = held ? share * block.phi[row] : 0.0;
        block.softness[row] = held ? 0.0 : free;
        block.impulse[row] = 0.0;
      }
    }
    System system{held_, inverse_mass_, u};
    system.limits = {kMostMemory, kMostWork - work_};
    const SolveReport solved = solver_.solve(system, Settings{});
    work_ += static_cast<double>(solved.flops);
    over_limits_ = over_limits_ || solved.status == SolveStatus::kOverLimits;
    return !over_limits_;
  }

  /// True if a solve exceeded the limits.
  [[nodiscard]] bool over_limits() const { return over_limits_; }

  /// Moves the bodies: translation, and rotation about world axes by the Cayley map, as in
  /// sub-steps.
  void move(std::span<const Vec6> by) {
    for (const int body : all_.moving) {
      const std::size_t i = index(body);
      state_.x[i] += by[i].head<3>();
      const Vec3 half = 0.5 * by[i].tail<3>();
      state_.q[i] = (Quat(1.0, half.x(), half.y(), half.z()) * state_.q[i]).normalized();
    }
  }

 private:
  template <class Visit>
  void for_holding(Visit visit) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const Block& block = blocks_.all()[i];
      for (int row = 0; row < block.rows; ++row) {
        const bool held = row < block.position_rows ? holds_[i].anchors : holds_[i].axes;
        if (held) visit(block, row, sizes_[i]);
      }
    }
  }

  State& state_;
  Part all_;
  JointStage joints_;
  std::vector<InertiaInverse> own_;
  std::vector<Mat3> R_WB_;
  std::vector<InverseMass> inverse_mass_;
  std::vector<double> sizes_;  // per joint [m]
  std::vector<HoldingRows> holds_;
  Blocks blocks_;
  std::vector<Block> held_;  // without the rows of springs
  double work_ = 0.0;        // total of all solves [floating-point operations]
  bool over_limits_ = false;
  Bpp solver_;
};

/// Largest entry; NaN if any entry is NaN.
double largest(std::span<const Vec6> moves) {
  double most = 0.0;
  for (const Vec6& move : moves) {
    const double size = move.cwiseAbs().maxCoeff();
    most = size > most || !move.allFinite() ? size : most;
  }
  return most;
}

/// Newton's method on the joint errors with minimum-norm steps. Steps that increase the error are
/// shortened, until rounding. @return false if a solve exceeds the limits or the error is not
/// finite
bool onto_joints(StartRows& rows, State& state) {
  std::vector<Vec6> step(state.x.size());
  rows.update();
  double error = rows.error();
  for (int i = 0; i < kMostClosing && error > kClosedError; ++i) {
    const State before = state;
    double share = 1.0;
    double next = error;
    do {
      state = before;
      rows.update();
      std::fill(step.begin(), step.end(), Vec6::Zero());
      if (!rows.solve(share, step)) return false;
      rows.move(step);
      rows.update();
      next = rows.error();
      share *= 0.5;
    } while (!(next < error) && share > 0.02);
    if (!(next < error)) {  // at rounding level, or no descent
      state = before;
      rows.update();
      break;
    }
    error = next;
  }
  return std::isfinite(error);
}

/// Displacement of each body from its start: translation, and rotation as twice the Cayley vector,
/// as in move(). It needs only sqrt, so every build computes the same start [m, rad].
void moves_from(const State& start, const State& state, std::span<Vec6> moved) {
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Quat turn = state.q[i] * start.q[i].conjugate();
    moved[i].head<3>() = state.x[i] - start.x[i];
    moved[i].tail<3>() = 2.0 / turn.w() * turn.vec();
  }
}

/// Slides along the constraint manifold until the displacement is along J^T: the smallest change.
/// Each step goes to the point of the linearised constraints nearest to the start.
void to_least_change(StartRows& rows, const State& start, State& state) {
  std::vector<Vec6> moved(state.x.size());
  std::vector<Vec6> step(state.x.size());
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostNearing; ++i) {
    moves_from(start, state, moved);
    for (std::size_t k = 0; k < step.size(); ++k) step[k] = -moved[k];
    if (!rows.solve(1.0, step)) return;
    const double size = largest(step);
    // With strongly curved constraints the steps do not shrink; the current state is accepted.
    if (!(size < 0.9 * last)) return;
    const State before = state;
    rows.move(step);
    if (!onto_joints(rows, state)) {
      state = before;
      rows.update();
      return;
    }
    if (size <= kClosedError * (1.0 + largest(moved))) return;
    last = size;
  }
}

}  // namespace

Projection close_joints(const Scene& scene, State& state) {
  if (!is_runnable(scene) || !fits(state, scene)) return Projection::kFailed;
  for (const int body : whole(scene).moving) state.q[index(body)].normalize();
  const State start = state;
  StartRows rows(scene, state);
  const bool closed = onto_joints(rows, state);
  if (closed && !start_errors(scene, state).beyond.poses()) to_least_change(rows, start, state);
  if (rows.over_limits()) return Projection::kTooLarge;
  return closed && !start_errors(scene, state).beyond.poses() ? Projection::kDone
                                                              : Projection::kFailed;
}

Projection match_velocities(const Scene& scene, State& state) {
  if (!is_runnable(scene) || !fits(state, scene)) return Projection::kFailed;
  StartRows rows(scene, state);
  double error = rows.error_of(state.u);
  for (int i = 0; i < kMostMatching; ++i) {
    std::vector<Vec6> u = state.u;
    if (!rows.solve(0.0, u)) break;
    const double next = rows.error_of(u);
    if (!(next < error)) break;
    state.u = u;
    error = next;
  }
  state.u_synchronised = state.u;
  if (rows.over_limits()) return Projection::kTooLarge;
  return start_errors(scene, state).beyond.velocities() ? Projection::kFailed : Projection::kDone;
}

}  // namespace substep
