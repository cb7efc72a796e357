#pragma once
// Random systems for solvers, and the same as dense matrices.

#include <algorithm>
#include <limits>
#include <vector>

#include "core/math/across.hpp"
#include "core/math/dense.hpp"
#include "core/solver/solver.hpp"
#include "tests/support/dense_oracle.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {

/// A random system: a few bodies, joint blocks and contact blocks between them.
struct RandomSystem {
  std::vector<Block> blocks;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u;
  [[nodiscard]] System system() { return {blocks, inverse_mass, u}; }
};

struct SystemSize {
  int bodies = 3;
  int joints = 2;
  int contacts = 2;
  double mu = 0.0;
  double softness = 0.01;     // rows have up to twenty times as much [1/kg]
  int joint_rows = kMaxRows;  // at most
  int motors = 0;             // with bounds below and above, some of them above or below 0
};

/// A joint of rigid bodies, at random arms and axes. Data that follows from the arms is poisoned.
inline void pin(Random& random, Block& block) {
  for (int row = 0; row < kMaxRows; ++row) {
    for (int j = 0; j < 6; ++j) {
      block.J_a[row][j] = block.J_b[row][j] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  block.r_a = random_vector(random);
  block.r_b = random_vector(random);
  Vec3 v[2];  // across b's axis; a's axis is off by up to half a radian
  const Vec3 axis_b = random_vector(random).normalized();
  across(axis_b, v[0], v[1]);
  const Vec3 axis_a = (axis_b + 0.3 * random_vector(random)).normalized();
  const Vec3 turned[] = {axis_a.cross(v[0]), axis_a.cross(v[1]), axis_a};
  for (int row = 3; row < block.rows; ++row) {
    const Vec3& J = turned[row - 3];
    for (int j = 0; j < 3; ++j) {
      block.J_a[row][j] = 0.0;
      block.J_a[row][3 + j] = J[j];
    }
  }
}

inline RandomSystem random_system(Random& random, const SystemSize& size) {
  RandomSystem problem;
  for (int i = 0; i < size.bodies; ++i) {
    InverseMass mass;
    mass.linear = uniform(random, 0.2, 2.0);
    const Mat3 R = random_rotation(random).toRotationMatrix();
    const Vec3 d{uniform(random, 0.5, 5.0), uniform(random, 0.5, 5.0), uniform(random, 0.5, 5.0)};
    const Mat3 W = R * d.asDiagonal() * R.transpose();
    mass.angular = 0.5 * (W + W.transpose());
    problem.inverse_mass.push_back(mass);
    Vec6 u;
    u << random_vector(random), random_vector(random);
    problem.u.push_back(u);
  }
  for (int i = 0; i < size.joints + size.contacts + size.motors; ++i) {
    Block block;
    const bool motor = i >= size.joints + size.contacts;
    const bool contact = i >= size.joints && !motor;
    if (motor) {
      block.kind = BlockKind::kFirstCoordinate;
      block.rows = 1;
      block.lo = uniform(random, -0.3, 0.05);
      block.hi = block.lo + uniform(random, 0.0, 0.3);
    } else if (contact) {
      block.kind = BlockKind::kContact;
      block.rows = size.mu > 0.0 ? 3 : 1;
      block.mu = size.mu;
    } else {  // any number of rows; solvers may use that half of them connect points
      block.has_point_rows = i % 4 < 2;
      const int fewest = block.has_point_rows ? 3 : 1;
      block.rows =
          fewest + static_cast<int>(random() % static_cast<unsigned>(size.joint_rows + 1 - fewest));
      block.position_rows = static_cast<std::int8_t>(std::min(block.rows, 3));
    }
    block.a = static_cast<int>(random() % static_cast<unsigned>(size.bodies));
    block.b = static_cast<int>(random() % static_cast<unsigned>(size.bodies + 1)) - 1;
    if (block.a == block.b) block.b = -1;
    if (i % 5 == 4 && block.b >= 0) block.a = -1;  // only b moves
    block.id = static_cast<std::uint64_t>(i);
    for (int row = 0; row < kMaxRows; ++row) {
      for (int j = 0; j < 6; ++j) {
        block.J_a[row][j] = uniform(random);
        block.J_b[row][j] = uniform(random);
      }
      block.softness[row] = uniform(random, size.softness, 20.0 * size.softness);
      block.bias[row] = uniform(random);
      block.impulse[row] = 0.0;
      block.active_set[row] = contact || motor ? kUnknownSet : std::int8_t{0};
    }
    if (block.has_point_rows) pin(random, block);
    problem.blocks.push_back(block);
  }
  return problem;
}

/// The same system as dense matrices: A x + q = w.
struct Dense {
  Eigen::MatrixXd A;
  Eigen::VectorXd q;
  struct Row {
    std::size_t block;
    int row;
  };
  std::vector<Row> rows;
};

inline Dense dense(const RandomSystem& problem) {
  Dense out;
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    for (int row = 0; row < problem.blocks[i].rows; ++row) out.rows.push_back({i, row});
  }
  const auto n = static_cast<Eigen::Index>(out.rows.size());
  out.A = Eigen::MatrixXd::Zero(n, n);
  out.q = Eigen::VectorXd::Zero(n);
  const auto n_bodies = static_cast<Eigen::Index>(problem.u.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, 6 * n_bodies);
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(6 * n_bodies, 6 * n_bodies);
  Eigen::VectorXd u(6 * n_bodies);
  for (Eigen::Index i = 0; i < n_bodies; ++i) {
    const InverseMass& mass = problem.inverse_mass[static_cast<std::size_t>(i)];
    W.block<3, 3>(6 * i, 6 * i) = mass.linear * Mat3::Identity();
    W.block<3, 3>(6 * i + 3, 6 * i + 3) = mass.angular;
    u.segment<6>(6 * i) = problem.u[static_cast<std::size_t>(i)];
  }
  for (Eigen::Index r = 0; r < n; ++r) {
    const Dense::Row& row = out.rows[static_cast<std::size_t>(r)];
    const Block& block = problem.blocks[row.block];
    if (block.a >= 0) J.block<1, 6>(r, 6 * block.a) = gradient(block, row.row, true).transpose();
    if (block.b >= 0) J.block<1, 6>(r, 6 * block.b) = gradient(block, row.row, false).transpose();
    out.A(r, r) = block.softness[row.row];
    out.q[r] = block.bias[row.row];
  }
  out.A += product(product(J, W), AnyMatrix(J.transpose()));
  out.q += product(J, u);
  return out;
}

inline Eigen::VectorXd impulses(const RandomSystem& problem) {
  std::vector<double> x;
  for (const Block& block : problem.blocks) {
    for (int row = 0; row < block.rows; ++row) x.push_back(block.impulse[row]);
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

inline Settings settings_for(SolverKind kind) {
  Settings settings;
  settings.solver = kind;
  settings.iterations = 4000;  // Gauss-Seidel until it has converged
  return settings;
}

}  // namespace substep::test
