// Claims about the two linear solvers by their sources, on a row of balls that press on each other:
// Erleben 2013 for projected Gauss-Seidel, Judice and Pires 1994 for block principal pivoting.

#include <cmath>

#include "core/solver/solver.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// Unit masses on a line, each with one row to the previous one, the first to the world: a contact,
/// or a link that also pulls. Velocities are random, so that about half of the contacts end closed.
struct RowOfBalls {
  std::vector<Block> blocks;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u;

  RowOfBalls(Random& random, int balls, BlockKind kind) {
    for (int i = 0; i < balls; ++i) {
      inverse_mass.push_back({1.0, Mat3::Identity()});
      Vec6 velocity = Vec6::Zero();
      velocity[0] = uniform(random);
      u.push_back(velocity);
      Block block;
      block.kind = kind;
      block.rows = 1;
      block.a = i;
      block.b = i - 1;
      block.id = static_cast<std::uint64_t>(i);
      for (int j = 0; j < 6; ++j) {
        block.J_a[0][j] = j == 0 ? 1.0 : 0.0;
        block.J_b[0][j] = j == 0 ? -1.0 : 0.0;
      }
      block.softness[0] = 0.01;
      block.bias[0] = 0.0;
      block.impulse[0] = 0.0;
      block.active_set[0] = kind == BlockKind::kContact ? kUnknownSet : std::int8_t{0};
      blocks.push_back(block);
    }
  }
  System system() { return {blocks, inverse_mass, u}; }
};

/// Distance of PGS from the solution after a number of sweeps, over all bodies [m/s].
double error_after(int sweeps, BlockKind kind) {
  Random random(61);
  RowOfBalls row(random, 12, kind);
  RowOfBalls exact = row;
  make_solver(SolverKind::kBpp)->solve(exact.system(), Settings{});
  Settings settings;
  settings.iterations = sweeps;
  const SolveReport report = make_solver(SolverKind::kPgs)->solve(row.system(), settings);
  EXPECT_EQ(report.row_updates, 12 * sweeps) << "the work of a sweep is linear in the rows";
  double sum = 0.0;
  for (std::size_t i = 0; i < row.u.size(); ++i) sum += (row.u[i] - exact.u[i]).squaredNorm();
  return std::sqrt(sum);
}

// Convergence is linear: equal numbers of sweeps reduce the residual by the same factor, also once
// the closed contacts are known.
TEST(PgsClaims, ConvergesLinearly) {
  for (const BlockKind kind : {kind_of(BallJoint{}), BlockKind::kContact}) {
    const double e[] = {error_after(100, kind), error_after(150, kind), error_after(200, kind)};
    EXPECT_LT(e[1], 0.5 * e[0]);
    EXPECT_NEAR((e[2] / e[1]) / (e[1] / e[0]), 1.0, 0.01);
  }
}

/// Number of systems that a cold-started BPP factors, mean of 40 rows of balls.
double factorisations(int balls) {
  double sum = 0.0;
  constexpr int kRows = 40;
  for (unsigned seed = 0; seed < kRows; ++seed) {
    Random random(200 + seed);
    RowOfBalls row(random, balls, BlockKind::kContact);
    const SolveReport report =
        make_solver(SolverKind::kBpp)->solve(row.system(), Settings{.pivots = 100});
    EXPECT_EQ(report.status, SolveStatus::kSolved);
    EXPECT_LT(lcp_residual(row.system()), 1e-10);
    sum += report.factorisations;
  }
  return sum / kRows;
}

// Whole blocks of rows change sets at once, so the number of systems hardly grows with the problem:
// 2.9 for ten rows, 4.7 for a hundred, 5.5 for 500; one row at a time would take hundreds.
TEST(BppClaims, TakesFewPivotsAtAnySize) {
  const double ten = factorisations(10);
  const double many = factorisations(500);
  EXPECT_GT(ten, 1.5) << "the first active set was correct";
  EXPECT_LT(many, 2.5 * ten);
}

}  // namespace
}  // namespace substep::test
