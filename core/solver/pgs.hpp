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
  /// What an iteration reads of a block, packed in the order of the visits.
  struct Visit {
    double J_a[kMaxRows][6];
    double J_b[kMaxRows][6];
    double coupling[kMaxRows][kMaxRows];  // J_i Mt^-1 J_j^T within the block, j < i
    double inverse_diagonal[kMaxRows];    // 1/(J_i Mt^-1 J_i^T + softness_i)
    double bias[kMaxRows];
    double softness[kMaxRows];
    double impulse[kMaxRows];
    double mu;
    int a;
    int b;
    int rows;
    bool contact;
    bool pinned;
  };

  template <int Rows, bool Pinned>
  static void visit(Visit& block, const System& system);

  std::vector<Visit> visits_;
};

}  // namespace substep
