// Block principal pivoting: digits, refinements, friction in impacts, and the course of its pivots.

#include "core/solver/bpp.hpp"

#include <cmath>
#include <optional>

#include "tests/support/keep_largest.hpp"
#include "tests/unit/random_system.hpp"

namespace substep::test {
namespace {

/// A tree of joints that leave a direction free, so that no row is redundant, and loops with one
/// more row each.
RandomSystem random_tree(Random& random, int bodies, int loops, double softness) {
  RandomSystem problem =
      random_system(random, {bodies, bodies, loops, 0.0, softness, kMaxRows - 1});
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
double error_of_linear_solve(RandomSystem problem) {
  const Dense d = dense(problem);
  std::vector<Vec6> u = problem.u;
  Bpp().solve(problem.system(), settings_for(SolverKind::kBpp));
  const Eigen::VectorXd x = impulses(problem);
  for (const Block& block : problem.blocks) {
    apply_impulse(block, block.impulse, problem.inverse_mass, u);
  }
  double error = (product(d.A, x) + d.q).norm();
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
double left_of_regularisation(const RandomSystem& problem, double regularisation, int refinements) {
  RandomSystem plain = problem;
  Bpp().solve(plain.system(), Settings{});
  RandomSystem refined = problem;
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
  for (const SystemSize& size : {SystemSize{5, 4, 0}, SystemSize{5, 0, 4}, SystemSize{5, 3, 4}}) {
    for (int trial = 0; trial < 50; ++trial) {
      const RandomSystem problem = random_system(random, size);
      const double none = left_of_regularisation(problem, 0.3, 0);
      if (none == 0.0) continue;  // carries no force
      EXPECT_LT(left_of_regularisation(problem, 0.3, 5), 0.7 * none);
      EXPECT_LT(left_of_regularisation(problem, 0.3, 1000), 1e-8);
    }
  }
}

// As close_joints() in core/sim solves again, with the bias of the solve before.
TEST(Bpp, RefinementsGoOnInAnotherSolve) {
  Random random(25);
  for (int trial = 0; trial < 50; ++trial) {
    const RandomSystem problem = random_system(random, {5, 3, 4});
    RandomSystem plain = problem;
    Bpp().solve(plain.system(), Settings{});
    RandomSystem refined = problem;
    for (Block& block : refined.blocks) {
      for (int row = 0; row < block.rows; ++row) block.softness[row] += 0.3;
    }
    System system = refined.system();
    system.regularisation = 0.3;
    Settings settings;
    settings.refinements = 1000;
    Bpp bpp;
    bpp.solve(system, settings);
    for (int again = 0; again < 3; ++again) {
      std::copy(problem.u.begin(), problem.u.end(), refined.u.begin());
      bpp.find_velocities_again(system, settings, false);
    }
    for (std::size_t i = 0; i < plain.u.size(); ++i) {
      EXPECT_LT((plain.u[i] - refined.u[i]).norm(), 1e-7) << trial;
    }
  }
}

// It starts from the last forces: at rest one solve is enough.
TEST(Bpp, RefinementsStartFromTheLastForces) {
  Random random(24);
  for (int trial = 0; trial < 50; ++trial) {
    RandomSystem problem = random_system(random, {5, 3, 4});
    RandomSystem solved = problem;
    Bpp().solve(solved.system(), Settings{});
    for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
      std::copy(solved.blocks[i].impulse, solved.blocks[i].impulse + kMaxRows,
                problem.blocks[i].impulse);
    }
    EXPECT_LT(left_of_regularisation(problem, 0.3, 1), 1e-9);
  }
}

// Of a slender body that hits with one end, in any direction, with tangents in any direction.
TEST(Bpp, AnObliqueImpactSticksWithinTheCone) {
  Random random(19);
  int sticking = 0;
  for (int trial = 0; trial < 200; ++trial) {
    RandomSystem problem = random_system(random, {1, 0, 1, 1.0});
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

// The initial active set must not change the result, to the last bit.
TEST(Bpp, DoesNotDependOnTheInitialActiveSet) {
  Random random(18);
  Bpp solver;
  for (int trial = 0; trial < 300; ++trial) {
    const RandomSystem problem = random_system(random, {4, 2, 6, 0.0});
    std::optional<Eigen::VectorXd> first;
    // 1 is not a valid state of a normal row and is treated as unknown.
    for (const std::int8_t start : {kUnknownSet, std::int8_t{0}, std::int8_t{-1}, std::int8_t{1}}) {
      RandomSystem copy = problem;
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
    const RandomSystem problem = random_system(random, {4, 6, 2, 0.0});
    RandomSystem before = problem;
    RandomSystem after = problem;
    solver.solve(before.system(), settings_for(SolverKind::kBpp));
    solver.reserve(static_cast<std::size_t>(100 * (trial + 1)), 1000, false);
    solver.solve(after.system(), settings_for(SolverKind::kBpp));
    EXPECT_EQ(impulses(before), impulses(after));
  }
}

/// Two bodies, the first held twice by the same rows, and the second if asked.
RandomSystem held_twice(bool second_too) {
  Random random(23);
  RandomSystem problem = random_system(random, {2, 1, 0, 0.0, 0.0, 3});
  Block first = problem.blocks[0];
  first.a = 0;
  first.b = -1;
  Block second = first;
  second.a = 1;
  problem.blocks = {first, first};
  if (second_too) problem.blocks.insert(problem.blocks.end(), {second, second});
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) problem.blocks[i].id = i;
  return problem;
}

// A body without rows is in no node of the factor. Its velocity in an earlier solve must not decide
// when the corrections of redundant rows end.
TEST(Bpp, RedundantRowsDoNotReadVelocitiesOfAnEarlierSolve) {
  RandomSystem fresh = held_twice(false);
  Bpp().solve(fresh.system(), settings_for(SolverKind::kBpp));
  RandomSystem fast = held_twice(true);
  fast.u[1] *= 1e15;
  RandomSystem after = held_twice(false);
  Bpp solver;
  solver.solve(fast.system(), settings_for(SolverKind::kBpp));
  solver.solve(after.system(), settings_for(SolverKind::kBpp));
  EXPECT_EQ(impulses(fresh), impulses(after));
}

TEST(Bpp, SingleRowPivotsAlsoConverge) {
  Random random(19);
  Bpp solver;
  Settings settings = settings_for(SolverKind::kBpp);
  settings.pivots = 0;  // the fallback from the first step
  for (int trial = 0; trial < 300; ++trial) {
    RandomSystem problem = random_system(random, {4, 2, 8, 0.0});
    const SolveReport report = solver.solve(problem.system(), settings);
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT(lcp_residual(problem.system()), 1e-8);
  }
}

TEST(Bpp, FindsTheSolutionFromInsideTheBounds) {
  Random random(19);
  Bpp solver;
  Settings settings = settings_for(SolverKind::kBpp);
  settings.pivots = 0;  // no block pivots
  int solved = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double mu = trial % 2 == 0 ? 0.0 : 0.5;
    RandomSystem problem = random_system(random, {4, 2, 8, mu, 0.01, kMaxRows, trial % 3});
    System system = problem.system();
    system.contacts_yield = true;
    const SolveReport report = solver.solve(system, settings);
    EXPECT_LE(report.status, SolveStatus::kUnsettled);
    if (mu == 0.0) {
      EXPECT_EQ(report.status, SolveStatus::kSolved);
    }
    if (report.status == SolveStatus::kSolved) {
      ++solved;
      EXPECT_LT(lcp_residual(problem.system()), 1e-8);
    }
  }
  EXPECT_GT(solved, 150) << "with friction, too";
}

/// Towers of bodies that touch at nearly the same four points each, so that one row of four is
/// redundant but for a little softness and a little disagreement.
RandomSystem redundant_towers(Random& random, int towers, int height) {
  RandomSystem problem =
      random_system(random, {towers * height, 0, 4 * towers * height, 0.0, 1e-5});
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    Block& block = problem.blocks[i];
    const int body = static_cast<int>(i / 4);
    const int corner = static_cast<int>(i % 4);
    block.a = body;
    block.b = body % height == 0 ? -1 : body - 1;
    const double x = corner % 2 == 0 ? 0.5 : -0.5;
    const double z = corner / 2 == 0 ? 0.5 : -0.5;
    const Vec6 J_a{0.0, 1.0, 0.0, -z, 0.0, x};
    for (int j = 0; j < 6; ++j) {
      block.J_a[0][j] = J_a[j];
      block.J_b[0][j] = -J_a[j];
    }
    block.bias[0] = 1e-3 * uniform(random);
  }
  for (Vec6& u : problem.u) u = Vec6{0.0, -0.16, 0.0, 0.0, 0.0, 0.0};
  return problem;
}

TEST(Bpp, RedundantRowsDoNotMakeItCycle) {
  Random random(24);
  Bpp solver;
  for (int trial = 0; trial < 20; ++trial) {
    RandomSystem problem = redundant_towers(random, 10, 12);
    System system = problem.system();
    system.contacts_yield = true;
    const SolveReport report = solver.solve(system, settings_for(SolverKind::kBpp));
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT(report.factorisations, 60);
    EXPECT_LT(lcp_residual(problem.system()), 1e-7);
  }
}

TEST(Bpp, EveryRowMayBeAtItsBound) {
  Random random(20);
  RandomSystem problem = random_system(random, {3, 0, 3, 0.5});
  for (Block& block : problem.blocks) block.bias[0] = 100.0;  // all separate
  const std::vector<Vec6> u = problem.u;
  Bpp solver;
  solver.solve(problem.system(), settings_for(SolverKind::kBpp));
  EXPECT_EQ(impulses(problem).norm(), 0.0);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], problem.u[i]);
}

}  // namespace
}  // namespace substep::test
