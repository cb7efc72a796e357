#include "core/lab/linear_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/constraints/contact.hpp"
#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/forces/applied_forces.hpp"
#include "core/math/dense.hpp"
#include "core/math/disjoint_sets.hpp"
#include "core/math/gyroscopic.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"
#include "core/stepping/compliance.hpp"
#include "core/stepping/drift.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/stiffness_bound.hpp"

namespace substep {
namespace {

constexpr double kDependentRow = 1e-9;  // of rows scaled to 1: below it others imply one
// dt^2 k/m over a frame, from which a compliant row is taken as rigid.
constexpr double kStiff = 1e4;

/// Moving bodies that joints connect, with their joints; groups without joints too.
std::vector<Part> groups_of(const Scene& scene) {
  DisjointSets connected;
  connected.reset(scene.bodies.size());
  if (scene.effects.joints) {
    for (const Joint& joint : scene.joints) {
      const JointBase& of = base(joint);
      if (is_fixed(scene, of.a) || is_fixed(scene, of.b)) continue;
      connected.unite(of.a, of.b);
    }
  }
  std::vector<Part> groups;
  std::vector<int> group_of(scene.bodies.size(), -1);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    int& group = group_of[index(connected.root(static_cast<int>(i)))];
    if (group < 0) {
      group = static_cast<int>(groups.size());
      groups.emplace_back().has.resize(scene.bodies.size());
    }
    group_of[i] = group;
    Part& part = groups[index(group)];
    part.moving.push_back(static_cast<int>(i));
    part.bodies.push_back(static_cast<int>(i));
    part.has[i] = 1;
  }
  for (std::size_t j = 0; j < scene.joints.size() && scene.effects.joints; ++j) {
    const JointBase& of = base(scene.joints[j]);
    const int body = is_fixed(scene, of.a) ? of.b : of.a;
    if (is_fixed(scene, body)) continue;
    groups[index(group_of[index(body)])].joints.push_back(static_cast<int>(j));
  }
  return groups;
}

void sort_by_share(std::vector<LinearModel::Share>& shares) {
  std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
    return std::abs(a.share) > std::abs(b.share);
  });
}

}  // namespace

class LinearModel::Builder {
 public:
  Builder(const Scene& scene, const State& state)
      : scene_(scene), state_(state), place_(scene.bodies.size(), -1) {
    R_WB_.resize(scene.bodies.size());
    for (std::size_t i = 0; i < R_WB_.size(); ++i) R_WB_[i] = state.q[i].toRotationMatrix();
    inertia_inverse_ = inertia_inverses(scene);
    inverse_mass_.resize(scene.bodies.size());
  }

  LinearModel build(const Part& part) {
    LinearModel model;
    model.bodies_ = part.moving;
    model.joints_ = part.joints;
    for (std::size_t i = 0; i < part.moving.size(); ++i) {
      place_[index(part.moving[i])] = static_cast<int>(i);
    }
    inverse_mass(inertia_inverse_, part, R_WB_, inverse_mass_);
    size_ = 6 * std::ssize(part.moving);
    append_rows(part);
    find_forces(part);
    set_mass(part, model);
    set_basis(model);
    set_terms(model);
    set_criterion(part, model);
    for (const int body : part.moving) place_[index(body)] = -1;
    return model;
  }

 private:
  /// dt^2 k/m of a compliant row over a frame; infinite for a rigid one.
  [[nodiscard]] double kappa_of(const Block& block, int row) const {
    if (!(block.C[row] > 0.0)) return kNoLimit;
    const bool of_positions = row < block.position_rows;
    const int first = of_positions ? 0 : block.position_rows;
    const int end = of_positions ? block.position_rows : block.rows;
    return spring_kappa(scene_.frame * scene_.frame, inverse_mass_, block, first, end);
  }
  /// True if the stretch of the row gives its force; else it is that of a rigid row.
  [[nodiscard]] bool is_spring(const Block& block, int row) const {
    return !block.is_bounded() && kappa_of(block, row) < kResolved;
  }
  [[nodiscard]] bool is_rigid(const Block& block, int row) const {
    return kappa_of(block, row) > kStiff;
  }

  /// J of a row on the bodies of the group.
  [[nodiscard]] AnyVector row_of(const Block& block, int row) const {
    AnyVector J = AnyVector::Zero(size_);
    for (const bool of_a : {true, false}) {
      const int body = of_a ? block.a : block.b;
      if (body < 0) continue;
      J.segment<6>(6 * place_[index(body)]) += gradient(block, row, of_a);
    }
    return J;
  }

  void append_rows(const Part& part) {
    blocks_.clear();
    const JointStage joints(scene_);
    joints.append(part, state_, R_WB_, blocks_);
    joint_blocks_ = blocks_.size();
    if (acts_on_coordinates(scene_.effects) && scene_.effects.joints) {
      stage_.emplace(scene_);
      stage_->append(part, state_, R_WB_, scene_.frame, true, blocks_);
    }
  }

  /// u' without rows: applied forces, gyroscopic torques, drives.
  AnyVector free_acceleration(const Part& part) const {
    AnyVector a = AnyVector::Zero(size_);
    for (const int body : part.moving) {
      const std::size_t i = index(body);
      Vec6 of_body = Vec6::Zero();
      for_each_force(scene_.effects, [&](auto force) {
        force.accelerate(scene_, scene_.bodies[i], inertia_inverse_[i], R_WB_[i], 1.0, of_body);
      });
      if (scene_.effects.gyroscopic) {
        const Vec3 omega_B = R_WB_[i].transpose() * Vec3(state_.u[i].tail<3>());
        const Vec3 torque = gyroscopic_torque(scene_.bodies[i].inertia, omega_B);
        of_body.tail<3>() += inverse_mass_[i].angular * (R_WB_[i] * torque);
      }
      a.segment<6>(6 * place_[i]) = of_body;
    }
    return a;
  }

  AnyVector times_inverse_mass(const AnyVector& J) const {
    AnyVector out(size_);
    for (std::size_t i = 0; i < place_.size(); ++i) {
      if (place_[i] < 0) continue;
      const Eigen::Index at = 6 * place_[i];
      out.segment<3>(at) = inverse_mass_[i].linear * J.segment<3>(at);
      out.segment<3>(at + 3) = inverse_mass_[i].angular * J.segment<3>(at + 3);
    }
    return out;
  }

  // The multipliers of J a + s lambda = -J' u for rigid rows and armatures, with the forces of
  // springs and drives given; motors, dry friction and limits hold while they can.
  void find_forces(const Part& part) {
    struct Row {
      Block* block;
      int row;
      AnyVector J;
      double curvature;
      double softness = 0.0;
      double least = -kUnbounded;
      double most = kUnbounded;
    };
    std::vector<Row> rows;
    AnyVector a = free_acceleration(part);
    double curvature[kMaxRows];
    for (Block& block : blocks_.all()) {
      curvature_of(block, state_.u, curvature);
      for (int row = 0; row < block.rows; ++row) {
        Row of{&block, row, row_of(block, row), curvature[row]};
        block.lambda[row] = 0.0;
        double given = 0.0;
        if (is_spring(block, row)) {
          given = -block.phi[row] / block.C[row];
        } else if (block.is_bounded() && !bounds(block, of.softness, of.least, of.most, given)) {
        } else {
          rows.push_back(std::move(of));
          continue;
        }
        block.lambda[row] = given;
        if (given != 0.0) a += given * times_inverse_mass(of.J);
      }
    }
    solve(rows, a);
  }

  /// Of a coordinate's row: whether it holds, between which forces, or what it exerts.
  bool bounds(const Block& block, double& softness, double& least, double& most,
              double& given) const {
    constexpr double kSlow = 1e-9;
    const double speed = normal_speed(block, state_.u);
    using Acts = CoordinateStage::Acts;
    switch (CoordinateStage::acts(block.id)) {
      case Acts::kLower:
      case Acts::kUpper:
        least = 0.0;
        return block.phi[0] < 1e-2 * stage_->width_of(block) && !(speed > kSlow);
      case Acts::kMotor: {
        const Motor& motor = stage_->motor(block);
        most = motor.effort;
        least = -most;
        given = speed < motor.velocity ? most : least;
        return std::abs(speed - motor.velocity) <= kSlow * (1.0 + std::abs(motor.velocity));
      }
      case Acts::kFriction:
        most = stage_->friction(block);
        least = -most;
        given = speed < 0.0 ? most : least;
        return std::abs(speed) <= kSlow;
      case Acts::kDrive:
      case Acts::kSpring: {
        const Drive drive = stage_->drive(block);
        given = drive.stiffness * (drive.target - block.phi[0]) +
                drive.damping * (drive.velocity - speed);
        if (drive.effort) given = std::clamp(given, -*drive.effort, *drive.effort);
        return false;
      }
      case Acts::kArmature:
        softness = 1.0 / block.armature;
        return true;
    }
    return false;
  }

  template <class Rows>
  void solve(Rows& rows, const AnyVector& a) {
    constexpr int kMostRounds = 20;
    std::vector<std::uint8_t> held(rows.size(), 1);
    for (int round = 0; round < kMostRounds; ++round) {
      std::vector<std::size_t> active;
      AnyVector pushed = a;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (held[i]) {
          active.push_back(i);
        } else if (const double at = rows[i].block->lambda[rows[i].row]; at != 0.0) {
          pushed += at * times_inverse_mass(rows[i].J);
        }
      }
      const auto n = static_cast<Eigen::Index>(active.size());
      if (n == 0) return;
      AnyMatrix J(n, size_);
      AnyMatrix W(size_, n);
      AnyVector right(n);
      AnyVector scale(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto& row = rows[active[static_cast<std::size_t>(i)]];
        J.row(i) = row.J.transpose();
        W.col(i) = times_inverse_mass(row.J);
        right[i] = -row.curvature - row.J.dot(pushed);
      }
      AnyMatrix S = product(J, W);
      for (Eigen::Index i = 0; i < n; ++i) {
        S(i, i) += rows[active[static_cast<std::size_t>(i)]].softness;
        scale[i] = S(i, i) > 0.0 ? 1.0 / std::sqrt(S(i, i)) : 0.0;
      }
      for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < n; ++i) S(i, j) *= scale[i] * scale[j];
        right[j] *= scale[j];
      }
      AnyVector lambda = least_norm_solution(S, right, kDependentRow);
      for (Eigen::Index i = 0; i < n; ++i) lambda[i] *= scale[i];
      bool beyond = false;
      for (Eigen::Index i = 0; i < n; ++i) {
        auto& row = rows[active[static_cast<std::size_t>(i)]];
        const double within = std::clamp(lambda[i], row.least, row.most);
        row.block->lambda[row.row] = within;
        if (within == lambda[i]) continue;
        held[active[static_cast<std::size_t>(i)]] = 0;
        beyond = true;
      }
      if (!beyond) return;
    }
  }

  void set_mass(const Part& part, LinearModel& model) const {
    model.body_mass_.resize(6, size_);
    model.body_mass_.setZero();
    for (std::size_t i = 0; i < part.moving.size(); ++i) {
      const std::size_t body = index(part.moving[i]);
      const auto at = 6 * static_cast<Eigen::Index>(i);
      model.body_mass_.block<3, 3>(0, at) = scene_.bodies[body].mass * Mat3::Identity();
      model.body_mass_.block<3, 3>(3, at + 3) =
          R_WB_[body] * scene_.bodies[body].inertia.asDiagonal() * R_WB_[body].transpose();
    }
  }

  // With M = L L^T: q = L^-T Z y, Z an orthonormal basis of what leaves J L^-T unchanged, so that
  // rows and directions have no units. M is 1 without armatures.
  void set_basis(LinearModel& model) const {
    const int bodies = static_cast<int>(size_ / 6);
    std::vector<double> linear;  // L^-1 of each body's mass [1/sqrt(kg)]
    std::vector<Mat3> angular;   // L^-1 of its moments [1/(m sqrt(kg))]
    for (int i = 0; i < bodies; ++i) {
      linear.push_back(1.0 / std::sqrt(model.body_mass_(0, 6 * i)));
      const Cholesky moments(model.body_mass_.block<3, 3>(3, 6 * i + 3));
      angular.emplace_back(moments.solve_lower(Mat3::Identity()));
    }
    const auto half = [&](AnyVector v) {  // L^-1 v
      for (int i = 0; i < bodies; ++i) {
        v.segment<3>(6 * i) *= linear[index(i)];
        v.segment<3>(6 * i + 3) = angular[index(i)] * Vec3(v.segment<3>(6 * i + 3));
      }
      return v;
    };
    std::vector<AnyVector> rigid;
    for (std::size_t i = 0; i < joint_blocks_; ++i) {
      const Block& block = blocks_.all()[i];
      for (int row = 0; row < block.rows; ++row) {
        if (!is_rigid(block, row)) continue;
        AnyVector scaled = half(row_of(block, row));
        const double length = scaled.norm();
        if (length > 0.0) rigid.push_back(scaled / length);
      }
    }
    const auto n = static_cast<Eigen::Index>(rigid.size());
    AnyMatrix all(size_, n);
    for (Eigen::Index i = 0; i < n; ++i) all.col(i) = rigid[static_cast<std::size_t>(i)];
    AnyMatrix basis = orthogonal_complement(all, kDependentRow);
    model.redundant_ = static_cast<int>(n - (size_ - basis.cols()));
    for (int i = 0; i < bodies; ++i) {
      const Mat3 upper = angular[index(i)].transpose();
      for (Eigen::Index j = 0; j < basis.cols(); ++j) {
        basis.block<3, 1>(6 * i, j) *= linear[index(i)];
        basis.block<3, 1>(6 * i + 3, j) = upper * Vec3(basis.block<3, 1>(6 * i + 3, j));
      }
    }
    model.basis_ = std::move(basis);
  }

  void set_terms(LinearModel& model) {
    const AnyMatrix& basis = model.basis_;
    const Eigen::Index free = basis.cols();
    model.mass_ = AnyMatrix::Identity(free, free);
    model.springs_ = AnyMatrix::Zero(free, free);
    AnyMatrix stiffened = AnyMatrix::Zero(size_, free);  // -K times the basis
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const Block& block = blocks_.all()[i];
      const int joint =
          i < joint_blocks_ ? static_cast<int>(block.id) : CoordinateStage::joint_of(block.id);
      add_stiffness(block, joint, model, stiffened);
      if (i < joint_blocks_) {
        add_compliance(block, model);
        double square = 0.0;
        for (int row = 0; row < block.position_rows; ++row) {
          square += block.lambda[row] * block.lambda[row];
        }
        model.largest_force_ = std::max(model.largest_force_, std::sqrt(square));
        continue;
      }
      const AnyVector coordinate = transposed_product(basis, row_of(block, 0));
      if (is_armature(block)) {
        add_square(model.mass_, block.armature, coordinate);
      } else if (is_drive(block)) {
        const Drive drive = stage_->drive(block);
        model.drives_.push_back(
            {joint, coordinate, 0.0, drive.stiffness, drive.damping, is_joint_spring(block)});
      }
    }
    const AnyMatrix geometric = transposed_product(basis, stiffened);
    model.geometric_ = 0.5 * (geometric + geometric.transpose());
    const Cholesky factor(model.mass_);
    for (DriveTerm& drive : model.drives_) {
      const double mobility = drive.coordinate.dot(factor.solve(drive.coordinate));
      drive.inertia = mobility > 0.0 ? 1.0 / mobility : kNoLimit;
    }
    set_coordinates(model);
  }

  void add_stiffness(const Block& block, int joint, LinearModel& model,
                     AnyMatrix& stiffened) const {
    const auto place = [&](int body) { return body < 0 ? -1 : place_[index(body)]; };
    StiffnessMatrix K;
    K.clear(2);  // of the block's own bodies, 0 and 1
    Block own = block;
    own.a = block.a < 0 ? -1 : 0;
    own.b = block.b < 0 ? -1 : 1;
    with_joint_rows(block.kind, [&](auto rows) { rows.stiffness(own, K); });
    JointTerm term{joint, place(block.a), place(block.b), {}};
    const int places[] = {term.a, term.b};
    bool any = false;
    for (int on = 0; on < 2; ++on) {
      for (int by = 0; by < 2; ++by) {
        term.blocks[on][by] = Mat6::Zero();
        if (places[on] < 0 || places[by] < 0) continue;
        term.blocks[on][by] = -K.block(on, by);
        any = any || !term.blocks[on][by].isZero(0.0);
        for (Eigen::Index j = 0; j < stiffened.cols(); ++j) {
          stiffened.block<6, 1>(6 * places[on], j) +=
              term.blocks[on][by] * Vec6(model.basis_.block<6, 1>(6 * places[by], j));
        }
      }
    }
    if (any) model.terms_.push_back(term);
  }

  void add_compliance(const Block& block, LinearModel& model) const {
    for (int row = 0; row < block.rows; ++row) {
      if (is_rigid(block, row)) continue;
      add_square(model.springs_, 1.0 / block.C[row],
                 transposed_product(model.basis_, row_of(block, row)));
    }
  }

  // Every hinge and slide, with an armature or without.
  void set_coordinates(LinearModel& model) const {
    Scene with = scene_;
    with.effects = {};
    with.effects.joints = with.effects.armature = true;
    for (Joint& joint : with.joints) {
      std::visit(
          [](auto& of) {
            if constexpr (requires { of.armature; }) of.armature = 1.0;
          },
          joint);
    }
    Part part;
    part.joints = model.joints_;
    CoordinateStage stage(with);
    Blocks rows;
    stage.append(part, state_, R_WB_, scene_.frame, true, rows);
    for (const Block& row : rows.all()) {
      model.coordinates_.push_back(
          {CoordinateStage::joint_of(row.id), transposed_product(model.basis_, row_of(row, 0))});
    }
  }

  void set_criterion(const Part& part, LinearModel& model) {
    StiffnessStage stiffness(scene_);
    std::vector<Vec6> k;
    stiffness.evaluate(scene_, blocks_.all(), ContactTerms::kPaper, part, R_WB_, k);
    const StiffnessLeader leader = StiffnessStage::bound(scene_, part.moving, k);
    model.r_ = leader.r;
    model.r_body_ = leader.body;
  }

  const Scene& scene_;
  const State& state_;
  std::vector<Mat3> R_WB_;
  std::vector<InertiaInverse> inertia_inverse_;
  std::vector<InverseMass> inverse_mass_;
  std::vector<int> place_;  // per body of the scene: in the group, or -1
  Eigen::Index size_ = 0;
  Blocks blocks_;
  std::size_t joint_blocks_ = 0;
  std::optional<CoordinateStage> stage_;
};

std::vector<LinearModel> LinearModel::of(const Scene& scene, const State& state) {
  std::vector<LinearModel> models;
  if (!is_runnable(scene) || !fits(state, scene)) return models;
  Builder builder(scene, state);
  for (const Part& part : groups_of(scene)) {
    if (part.joints.empty() || std::ssize(part.moving) > kMostBodies) continue;
    models.push_back(builder.build(part));
  }
  return models;
}

std::vector<LinearModel::Share> LinearModel::bodies_of(const Eigen::VectorXd& mode) const {
  const AnyVector moved = product(basis_, mode);
  const double all = mode.dot(product(mass_, mode));
  std::vector<Share> shares;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    const Vec6 of = moved.segment<6>(at);
    const Vec6 momentum = Mat6(body_mass_.middleCols<6>(at)) * of;
    shares.push_back({bodies_[i], of.dot(momentum) / all});
  }
  sort_by_share(shares);
  return shares;
}

std::vector<LinearModel::Share> LinearModel::joints_of(const Eigen::VectorXd& mode) const {
  const AnyVector moved = product(basis_, mode);
  const double all = mode.dot(product(geometric_, mode));
  std::vector<Share> shares;
  if (!(all > 0.0)) return shares;
  for (const JointTerm& term : terms_) {
    const int places[] = {term.a, term.b};
    double sum = 0.0;
    for (int on = 0; on < 2; ++on) {
      for (int by = 0; by < 2; ++by) {
        if (places[on] < 0 || places[by] < 0) continue;
        const Vec6 pushed = term.blocks[on][by] * Vec6(moved.segment<6>(6 * places[by]));
        sum += moved.segment<6>(6 * places[on]).dot(pushed);
      }
    }
    const auto same = std::find_if(shares.begin(), shares.end(),
                                   [&](const Share& of) { return of.index == term.joint; });
    if (same != shares.end()) {
      same->share += sum / all;
    } else {
      shares.push_back({term.joint, sum / all});
    }
  }
  sort_by_share(shares);
  return shares;
}

std::vector<LinearModel::Share> LinearModel::coordinates_of(const Eigen::VectorXd& mode) const {
  std::vector<Share> shares;
  for (const CoordinateTerm& of : coordinates_) {
    const double moved = of.coordinate.dot(mode);
    shares.push_back({of.joint, moved * moved});
  }
  sort_by_share(shares);
  return shares;
}

}  // namespace substep
