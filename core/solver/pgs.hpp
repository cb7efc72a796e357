#pragma once

#include <vector>

#include "core/solver/solver.hpp"

namespace substep {

/// Projected Gauss-Seidel, matrix-free: sequential impulses on u, row by row in the order of the
/// blocks, friction bounds live. A fixed number of iterations; impulses start from zero or, with
/// Settings::warm_start, from the seeds.
class Pgs final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport solve(const System& system, const Settings& settings) override;

 private:
  /// Mt^-1 J^T of a row and 1/(J Mt^-1 J^T + softness).
  struct Row {
    double W_a[6];
    double W_b[6];
    double inverse_diagonal;
  };
  std::vector<Row> rows_;
};

}  // namespace substep
