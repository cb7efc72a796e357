// One suite for every solver, against an oracle that enumerates active sets.

#include "core/solver/solver.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>

#include "core/math/across.hpp"
#include "core/solver/bpp.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// A random system: a few bodies, joint blocks and contact blocks between them.
struct Problem {
  std::vector<Block> blocks;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u;
  [[nodiscard]] System system() { return {blocks, inverse_mass, u}; }
};

struct ProblemSize {
  int bodies = 3;
  int joints = 2;
  int contacts = 2;
  double mu = 0.0;
  double softness = 0.01;     // rows have up to twenty times as much [1/kg]
  int joint_rows = kMaxRows;  // at most
};

/// A joint of rigid bodies, at random arms and axes. Data that follows from the arms is poisoned.
void pin(Random& random, Block& block) {
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

Problem random_problem(Random& random, const ProblemSize& size) {
  Problem problem;
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
  for (int i = 0; i < size.joints + size.contacts; ++i) {
    Block block;
    const bool contact = i >= size.joints;
    if (contact) {
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
      block.active_set[row] = contact ? kUnknownSet : std::int8_t{0};
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

Dense dense(const Problem& problem) {
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
  out.A += J * W * J.transpose();
  out.q += J * u;
  return out;
}

/// Every solution of the boxed problem, found by enumerating all active sets. With friction, an
/// active row is the equation x_t = +-mu x_n.
std::vector<Eigen::VectorXd> enumerate(const Problem& problem) {
  const Dense d = dense(problem);
  const auto n = d.q.size();
  std::vector<Eigen::Index> boxed;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (problem.blocks[d.rows[static_cast<std::size_t>(i)].block].is_contact()) boxed.push_back(i);
  }
  int sets = 1;
  for (std::size_t i = 0; i < boxed.size(); ++i) sets *= 3;
  std::vector<Eigen::VectorXd> solutions;
  for (int code = 0; code < sets; ++code) {
    Eigen::MatrixXd M = d.A;
    Eigen::VectorXd rhs = -d.q;
    std::vector<int> set(static_cast<std::size_t>(n), 0);
    int rest = code;
    for (const Eigen::Index i : boxed) {
      const Dense::Row row = d.rows[static_cast<std::size_t>(i)];
      const int state = rest % 3 - 1;
      rest /= 3;
      set[static_cast<std::size_t>(i)] = state;
      if (state == 0) continue;
      M.row(i).setZero();
      M(i, i) = 1.0;
      rhs[i] = 0.0;
      if (row.row > 0) M(i, i - row.row) = -state * problem.blocks[row.block].mu;
    }
    const Eigen::VectorXd x = M.partialPivLu().solve(rhs);
    const Eigen::VectorXd w = d.A * x + d.q;
    bool valid = x.allFinite();
    constexpr double kSlack = 1e-9;
    for (const Eigen::Index i : boxed) {
      const Dense::Row row = d.rows[static_cast<std::size_t>(i)];
      const int state = set[static_cast<std::size_t>(i)];
      const double hi =
          row.row == 0 ? kUnbounded : problem.blocks[row.block].mu * std::max(0.0, x[i - row.row]);
      const double lo = row.row == 0 ? 0.0 : -hi;
      if (row.row == 0 && state > 0) valid = false;  // there is no upper bound
      if (state == 0 && (x[i] < lo - kSlack || x[i] > hi + kSlack)) valid = false;
      if (hi > lo && state < 0 && w[i] < -kSlack) valid = false;
      if (hi > lo && state > 0 && w[i] > kSlack) valid = false;
    }
    if (valid) solutions.push_back(x);
  }
  return solutions;
}

Eigen::VectorXd impulses(const Problem& problem) {
  std::vector<double> x;
  for (const Block& block : problem.blocks) {
    for (int row = 0; row < block.rows; ++row) x.push_back(block.impulse[row]);
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

Settings settings_for(SolverKind kind) {
  Settings settings;
  settings.solver = kind;
  settings.iterations = 4000;  // Gauss-Seidel until it has converged
  return settings;
}

class EverySolver : public testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver, testing::Values(SolverKind::kPgs, SolverKind::kBpp),
                         [](const auto& solver) {
                           return solver.param == SolverKind::kPgs ? std::string("Pgs")
                                                                   : std::string("Bpp");
                         });

TEST_P(EverySolver, MatchesTheEnumeratedSolutionWithoutFriction) {
  Random random(11);
  const auto solver = make_solver(GetParam());
  for (int trial = 0; trial < 1500; ++trial) {
    Problem problem = random_problem(random, {3, trial % 3, 1 + trial % 5, 0.0});
    const auto solutions = enumerate(problem);
    ASSERT_FALSE(solutions.empty());
    const SolveReport report = solver->solve(problem.system(), settings_for(GetParam()));
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT((impulses(problem) - solutions.front()).norm(), 1e-7) << "trial " << trial;
    EXPECT_LT(lcp_residual(problem.system()), 1e-8);
  }
}

TEST_P(EverySolver, MatchesAnEnumeratedSolutionWithFriction) {
  Random random(12);
  const auto solver = make_solver(GetParam());
  int settled = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    Problem problem = random_problem(random, {3, trial % 3, 1 + trial % 2, 0.4});
    const auto solutions = enumerate(problem);
    // The bounds change with the solution: BPP updates them four times per call, so it is called
    // until they have settled, as over successive sub-steps.
    const std::vector<Vec6> u = problem.u;
    double residual = kUnbounded;
    for (int call = 0; call < 20 && residual > 1e-10; ++call) {
      problem.u = u;
      solver->solve(problem.system(), settings_for(GetParam()));
      residual = lcp_residual(problem.system());
    }
    if (residual > 1e-7) continue;  // box friction may have no solution or several
    ++settled;
    double nearest = kUnbounded;
    for (const auto& x : solutions) nearest = std::min(nearest, (impulses(problem) - x).norm());
    EXPECT_LT(nearest, 1e-6) << "trial " << trial;
  }
  EXPECT_GT(settled, kTrials * 95 / 100);
}

TEST_P(EverySolver, JointsAloneAreALinearSystem) {
  Random random(13);
  const auto solver = make_solver(GetParam());
  for (int trial = 0; trial < 200; ++trial) {
    Problem problem = random_problem(random, {6, 4, 0, 0.0});
    const Dense d = dense(problem);
    solver->solve(problem.system(), settings_for(GetParam()));
    EXPECT_LT((impulses(problem) - d.A.ldlt().solve(-d.q)).norm(), 1e-7);
  }
}

/// A tree of joints that leave a direction free, so that no row is redundant, and loops with one
/// more row each.
Problem random_tree(Random& random, int bodies, int loops, double softness) {
  Problem problem = random_problem(random, {bodies, bodies, loops, 0.0, softness, kMaxRows - 1});
  for (int i = 0; i < bodies; ++i) {
    Block& block = problem.blocks[static_cast<std::size_t>(i)];
    block.a = i;
    block.b = static_cast<int>(random() % static_cast<unsigned>(i + 1)) - 1;
    if (i % 3 == 2 && block.b >= 0) std::swap(block.a, block.b);  // the child is b
  }
  for (Block& block : problem.blocks) {
    if (!block.is_contact()) continue;
    block.kind = kind_of(BallJoint{});
    block.active_set[0] = 0;
  }
  return problem;
}

/// Residuals of J u + s x + bias and of u - u* - Mt^-1 J^T x, relative to x.
double error_of_linear_solve(Problem problem) {
  const Dense d = dense(problem);
  std::vector<Vec6> u = problem.u;
  Bpp().solve(problem.system(), settings_for(SolverKind::kBpp));
  const Eigen::VectorXd x = impulses(problem);
  for (const Block& block : problem.blocks) {
    apply_impulse(block, block.impulse, problem.inverse_mass, u);
  }
  double error = (d.A * x + d.q).norm();
  for (std::size_t i = 0; i < u.size(); ++i) error += (problem.u[i] - u[i]).norm();
  return error / (1.0 + x.norm());
}

// Exact joints and stiff springs: a small softness costs no more digits than the eight that folded
// springs and pivots of redundant rows may lose.
TEST(Bpp, IsExactForAnySoftness) {
  Random random(21);
  for (const double softness : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12, 0.0}) {
    double tree = 0.0;
    double loop = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
      keep_largest(tree, error_of_linear_solve(random_tree(random, 8, 0, softness)));
      keep_largest(loop, error_of_linear_solve(random_tree(random, 8, 1, softness)));
    }
    EXPECT_LT(tree, 1e-8) << softness;
    EXPECT_LT(loop, 1e-7) << softness;
  }
}

/// Largest difference from the velocities without a regularisation, after a number of refinements.
double left_of_regularisation(const Problem& problem, double regularisation, int refinements) {
  Problem plain = problem;
  Bpp().solve(plain.system(), Settings{});
  Problem refined = problem;
  for (Block& block : refined.blocks) {
    for (int row = 0; row < block.rows; ++row) block.softness[row] += regularisation;
  }
  System system = refined.system();
  system.regularisation = regularisation;
  Settings settings;
  settings.refinements = refinements;
  Bpp().solve(system, settings);
  double worst = 0.0;
  for (std::size_t i = 0; i < plain.u.size(); ++i) {
    keep_largest(worst, (plain.u[i] - refined.u[i]).norm());
  }
  return worst;
}

TEST(Bpp, RefinementsRemoveTheRegularisation) {
  Random random(23);
  for (const ProblemSize& size :
       {ProblemSize{5, 4, 0}, ProblemSize{5, 0, 4}, ProblemSize{5, 3, 4}}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Problem problem = random_problem(random, size);
      const double none = left_of_regularisation(problem, 0.3, 0);
      if (none == 0.0) continue;  // carries no force
      EXPECT_LT(left_of_regularisation(problem, 0.3, 5), 0.7 * none);
      EXPECT_LT(left_of_regularisation(problem, 0.3, 1000), 1e-8);
    }
  }
}

// It starts from the last forces: at rest one solve is enough.
TEST(Bpp, RefinementsStartFromTheLastForces) {
  Random random(24);
  for (int trial = 0; trial < 50; ++trial) {
    Problem problem = random_problem(random, {5, 3, 4});
    Problem solved = problem;
    Bpp().solve(solved.system(), Settings{});
    for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
      std::copy(solved.blocks[i].impulse, solved.blocks[i].impulse + kMaxRows,
                problem.blocks[i].impulse);
    }
    EXPECT_LT(left_of_regularisation(problem, 0.3, 1), 1e-9);
  }
}

TEST_P(EverySolver, VelocitiesAreThoseOfTheImpulses) {
  Random random(14);
  const auto solver = make_solver(GetParam());
  for (int trial = 0; trial < 200; ++trial) {
    Problem problem = random_problem(random, {5, 3, 4, trial % 2 == 0 ? 0.0 : 0.5});
    std::vector<Vec6> expected = problem.u;
    solver->solve(problem.system(), settings_for(GetParam()));
    for (const Block& block : problem.blocks) {
      apply_impulse(block, block.impulse, problem.inverse_mass, expected);
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_LT((problem.u[i] - expected[i]).norm(), 1e-9);
  }
}

// Of a slender body that hits with one end, in any direction, with tangents in any direction.
TEST(Bpp, AnObliqueImpactSticksWithinTheCone) {
  Random random(19);
  int sticking = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Problem problem = random_problem(random, {1, 0, 1, 1.0});
    const Vec3 axis = random_vector(random).normalized();
    Mat3 W = 12.0 * (Mat3::Identity() - axis * axis.transpose()) + 600.0 * axis * axis.transpose();
    problem.inverse_mass[0].linear = 1.0;
    problem.inverse_mass[0].angular = W;
    Block& block = problem.blocks[0];
    block.a = 0;
    block.b = -1;
    block.r_a = 0.5 * axis;
    block.n = random_vector(random).normalized();
    Vec3 t1;
    Vec3 t2;
    across(block.n, t1, t2);
    const double turned = uniform(random, 0.0, 3.0);
    block.t1 = std::cos(turned) * t1 + std::sin(turned) * t2;
    block.t2 = block.n.cross(block.t1);
    set_row(block, 0, block.n);
    set_row(block, 1, block.t1);
    set_row(block, 2, block.t2);
    std::fill_n(block.softness, 3, 0.0);
    std::fill_n(block.bias, 3, 0.0);
    problem.u[0].setZero();
    problem.u[0].head<3>() = -block.n + 1e-3 * random_vector(random);
    substep::Settings settings;
    settings.friction_cone = FrictionCone::kCone;
    Bpp().solve(problem.system(), settings);
    const double along = std::hypot(block.impulse[1], block.impulse[2]);
    if (along > 0.9 * block.impulse[0]) continue;
    ++sticking;
    double speed[kMaxRows];
    row_speeds(block, problem.u, speed);
    EXPECT_LT(std::hypot(speed[1], speed[2]), 1e-9) << "trial " << trial;
  }
  EXPECT_GT(sticking, 100);
}

TEST(System, SpeedsAndForcesMatchTheGradients) {
  Random random(16);
  for (int trial = 0; trial < 50; ++trial) {
    const Problem problem = random_problem(random, {4, 4, 3, 0.5});
    for (const Block& block : problem.blocks) {
      double speed[kMaxRows];
      row_speeds(block, problem.u, speed);
      std::vector<Vec6> pushed(problem.u.size(), Vec6::Zero());
      const auto of = [&](int body) { return body < 0 ? nullptr : &pushed[index(body)]; };
      double x[kMaxRows];
      for (double& impulse : x) impulse = uniform(random);
      push(block, x, of(block.a), of(block.b));
      for (int row = 0; row < block.rows; ++row) {
        for (const bool a : {true, false}) {
          const int body = a ? block.a : block.b;
          if (body < 0) continue;
          const Vec6 J = gradient(block, row, a);
          speed[row] -= J.dot(problem.u[index(body)]);
          pushed[index(body)] -= J * x[row];
        }
        EXPECT_NEAR(speed[row], 0.0, 1e-14);
      }
      for (const Vec6& left : pushed) EXPECT_LT(left.norm(), 1e-14);
    }
  }
}

TEST_P(EverySolver, UnusedFieldsOfABlockDoNotMatter) {
  Random random(15);
  const auto solver = make_solver(GetParam());
  for (int trial = 0; trial < 50; ++trial) {
    Problem clean = random_problem(random, {4, 3, 3, 0.5});
    Problem poisoned = clean;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (Block& block : poisoned.blocks) {
      for (int row = 0; row < kMaxRows; ++row) {
        for (int j = 0; j < 6; ++j) {
          if (row >= block.rows) block.J_a[row][j] = block.J_b[row][j] = nan;
          if (block.a < 0 && !block.has_point_rows) block.J_a[row][j] = nan;
          if (block.b < 0) block.J_b[row][j] = nan;
        }
        if (row >= block.rows) block.bias[row] = block.softness[row] = block.impulse[row] = nan;
        block.phi[row] = block.C[row] = block.lambda[row] = nan;
      }
      block.n = Vec3::Constant(nan);
      if (!block.has_point_rows) block.r_a = block.r_b = block.n;
    }
    solver->solve(clean.system(), settings_for(GetParam()));
    solver->solve(poisoned.system(), settings_for(GetParam()));
    EXPECT_EQ(impulses(clean), impulses(poisoned));
    for (std::size_t i = 0; i < clean.u.size(); ++i) EXPECT_EQ(clean.u[i], poisoned.u[i]);
  }
}

TEST_P(EverySolver, WithoutBlocksVelocitiesAreUnchanged) {
  Random random(16);
  Problem problem = random_problem(random, {3, 0, 0, 0.0});
  const std::vector<Vec6> u = problem.u;
  make_solver(GetParam())->solve(problem.system(), settings_for(GetParam()));
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], problem.u[i]);
}

TEST(Solvers, AgreeWithEachOtherOnLargerProblems) {
  Random random(17);
  const auto pgs = make_solver(SolverKind::kPgs);
  const auto bpp = make_solver(SolverKind::kBpp);
  for (int trial = 0; trial < 50; ++trial) {
    Problem a = random_problem(random, {12, 8, 16, 0.0});
    Problem b = a;
    pgs->solve(a.system(), settings_for(SolverKind::kPgs));
    bpp->solve(b.system(), settings_for(SolverKind::kBpp));
    EXPECT_LT((impulses(a) - impulses(b)).norm(), 1e-6);
  }
}

// The initial active set must not change the result, to the last bit.
TEST(Bpp, DoesNotDependOnTheInitialActiveSet) {
  Random random(18);
  Bpp solver;
  for (int trial = 0; trial < 300; ++trial) {
    const Problem problem = random_problem(random, {4, 2, 6, 0.0});
    std::optional<Eigen::VectorXd> first;
    // 1 is not a valid state of a normal row and is treated as unknown.
    for (const std::int8_t start : {kUnknownSet, std::int8_t{0}, std::int8_t{-1}, std::int8_t{1}}) {
      Problem copy = problem;
      for (Block& block : copy.blocks) {
        if (block.is_contact()) block.active_set[0] = start;
      }
      solver.solve(copy.system(), settings_for(SolverKind::kBpp));
      if (!first) first = impulses(copy);
      EXPECT_EQ(*first, impulses(copy));
    }
  }
}

// reserve() may be called with a larger size at any time.
TEST(Bpp, ContinuesAfterMemoryIsReserved) {
  Random random(22);
  Bpp solver;
  for (int trial = 0; trial < 20; ++trial) {
    const Problem problem = random_problem(random, {4, 6, 2, 0.0});
    Problem before = problem;
    Problem after = problem;
    solver.solve(before.system(), settings_for(SolverKind::kBpp));
    solver.reserve(static_cast<std::size_t>(100 * (trial + 1)), 1000);
    solver.solve(after.system(), settings_for(SolverKind::kBpp));
    EXPECT_EQ(impulses(before), impulses(after));
  }
}

TEST(Bpp, SingleRowPivotsAlsoConverge) {
  Random random(19);
  Bpp solver;
  Settings settings = settings_for(SolverKind::kBpp);
  settings.pivots = 0;  // the fallback from the first step
  for (int trial = 0; trial < 300; ++trial) {
    Problem problem = random_problem(random, {4, 2, 8, 0.0});
    const SolveReport report = solver.solve(problem.system(), settings);
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT(lcp_residual(problem.system()), 1e-8);
  }
}

TEST(Bpp, EveryRowMayBeAtItsBound) {
  Random random(20);
  Problem problem = random_problem(random, {3, 0, 3, 0.5});
  for (Block& block : problem.blocks) block.bias[0] = 100.0;  // all separate
  const std::vector<Vec6> u = problem.u;
  Bpp solver;
  solver.solve(problem.system(), settings_for(SolverKind::kBpp));
  EXPECT_EQ(impulses(problem).norm(), 0.0);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], problem.u[i]);
}

}  // namespace
}  // namespace substep::test
