// One suite for every solver, against an oracle that enumerates active sets.

#include "core/solver/solver.hpp"

#include <limits>

#include "tests/unit/random_system.hpp"

namespace substep::test {
namespace {

/// Every solution of the boxed problem, found by enumerating all active sets. With friction, an
/// active row is the equation x_t = +-mu x_n.
std::vector<Eigen::VectorXd> enumerate(const RandomSystem& problem) {
  const Dense d = dense(problem);
  const auto n = d.q.size();
  std::vector<Eigen::Index> boxed;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (problem.blocks[d.rows[static_cast<std::size_t>(i)].block].binds()) boxed.push_back(i);
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
      const Block& block = problem.blocks[row.block];
      rhs[i] = row.row > 0 ? 0.0 : state < 0 ? block.lo : std::min(block.hi, 1e9);
      if (row.row > 0) M(i, i - row.row) = -state * problem.blocks[row.block].mu;
    }
    const Eigen::VectorXd x = solved(M, rhs);
    const Eigen::VectorXd w = product(d.A, x) + d.q;
    bool valid = x.allFinite();
    constexpr double kSlack = 1e-9;
    for (const Eigen::Index i : boxed) {
      const Dense::Row row = d.rows[static_cast<std::size_t>(i)];
      const Block& block = problem.blocks[row.block];
      const int state = set[static_cast<std::size_t>(i)];
      const double hi = row.row == 0 ? block.hi : block.mu * std::max(0.0, x[i - row.row]);
      const double lo = row.row == 0 ? block.lo : -hi;
      if (hi == kUnbounded && state > 0) valid = false;  // there is no upper bound
      if (state == 0 && (x[i] < lo - kSlack || x[i] > hi + kSlack)) valid = false;
      if (hi > lo && state < 0 && w[i] < -kSlack) valid = false;
      if (hi > lo && state > 0 && w[i] > kSlack) valid = false;
    }
    if (valid) solutions.push_back(x);
  }
  return solutions;
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
    RandomSystem problem = random_system(random, {3, trial % 3, 1 + trial % 5, 0.0});
    const auto solutions = enumerate(problem);
    ASSERT_FALSE(solutions.empty());
    const SolveReport report = solver->solve(problem.system(), settings_for(GetParam()));
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT((impulses(problem) - solutions.front()).norm(), 1e-7) << "trial " << trial;
    EXPECT_LT(lcp_residual(problem.system()), 1e-8);
  }
}

TEST_P(EverySolver, MatchesTheEnumeratedSolutionWithMotors) {
  Random random(18);
  const auto solver = make_solver(GetParam());
  int at_lo = 0;
  int at_hi = 0;
  for (int trial = 0; trial < 300; ++trial) {
    RandomSystem problem = random_system(
        random, {.joints = trial % 3, .contacts = trial % 3, .motors = 1 + trial % 3});
    for (Block& block : problem.blocks) {  // drives without a bound
      if (!block.is_motor() || random() % 4 > 0) continue;
      block.hi = kAnyEffort;
      block.lo = -kAnyEffort;
    }
    const auto solutions = enumerate(problem);
    ASSERT_FALSE(solutions.empty());
    EXPECT_EQ(solver->solve(problem.system(), settings_for(GetParam())).status,
              SolveStatus::kSolved);
    EXPECT_LT((impulses(problem) - solutions.front()).norm(), 1e-7) << "trial " << trial;
    EXPECT_LT(lcp_residual(problem.system()), 1e-8);
    for (const Block& block : problem.blocks) {
      if (!block.is_motor()) continue;
      at_lo += block.impulse[0] == block.lo ? 1 : 0;
      at_hi += block.impulse[0] == block.hi ? 1 : 0;
    }
  }
  EXPECT_GT(at_lo, 50);
  EXPECT_GT(at_hi, 50);
}

TEST_P(EverySolver, MatchesAnEnumeratedSolutionWithFriction) {
  Random random(12);
  const auto solver = make_solver(GetParam());
  int settled = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomSystem problem = random_system(random, {3, trial % 3, 1 + trial % 2, 0.4});
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
    RandomSystem problem = random_system(random, {6, 4, 0, 0.0});
    const Dense d = dense(problem);
    solver->solve(problem.system(), settings_for(GetParam()));
    EXPECT_LT((impulses(problem) - solved(d.A, -d.q)).norm(), 1e-7);
  }
}

TEST_P(EverySolver, VelocitiesAreThoseOfTheImpulses) {
  Random random(14);
  const auto solver = make_solver(GetParam());
  for (int trial = 0; trial < 200; ++trial) {
    RandomSystem problem = random_system(random, {5, 3, 4, trial % 2 == 0 ? 0.0 : 0.5});
    std::vector<Vec6> expected = problem.u;
    solver->solve(problem.system(), settings_for(GetParam()));
    for (const Block& block : problem.blocks) {
      apply_impulse(block, block.impulse, problem.inverse_mass, expected);
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_LT((problem.u[i] - expected[i]).norm(), 1e-9);
  }
}

TEST(System, SpeedsAndForcesMatchTheGradients) {
  Random random(16);
  for (int trial = 0; trial < 50; ++trial) {
    const RandomSystem problem = random_system(random, {4, 4, 3, 0.5});
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
    RandomSystem clean = random_system(random, {4, 3, 3, 0.5});
    RandomSystem poisoned = clean;
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
  RandomSystem problem = random_system(random, {3, 0, 0, 0.0});
  const std::vector<Vec6> u = problem.u;
  make_solver(GetParam())->solve(problem.system(), settings_for(GetParam()));
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], problem.u[i]);
}

TEST(Solvers, AgreeWithEachOtherOnLargerProblems) {
  Random random(17);
  const auto pgs = make_solver(SolverKind::kPgs);
  const auto bpp = make_solver(SolverKind::kBpp);
  for (int trial = 0; trial < 50; ++trial) {
    RandomSystem a = random_system(random, {12, 8, 16, 0.0});
    RandomSystem b = a;
    pgs->solve(a.system(), settings_for(SolverKind::kPgs));
    bpp->solve(b.system(), settings_for(SolverKind::kBpp));
    EXPECT_LT((impulses(a) - impulses(b)).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace substep::test
