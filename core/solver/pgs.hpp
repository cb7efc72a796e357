#pragma once

#include <vector>

#include "core/solver/solver.hpp"

namespace substep {

/// Projected Gauss-Seidel (Erleben 2013, "Numerical methods for linear complementarity problems in
/// physics-based animation"), matrix-free: sequential impulses on u, row by row in the order of the
/// blocks, friction bounds live. A fixed number of iterations; impulses start from zero or, with
/// Settings::warm_start, from the seeds.
class Pgs final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  /// What an iteration reads of a block, packed in the order of the visits. J is kept by component,
  /// so that the speeds of all rows are found side by side; rows beyond `rows` are zero.
  struct Visit {
    static constexpr std::size_t kPadded = kMaxRows + 1;  // an even number: two rows at a time
    double J_a[6][kPadded];
    double J_b[6][kPadded];
    double W_a[kMaxRows][6];  // Mt^-1 J^T by row
    double W_b[kMaxRows][6];
    double coupling[kMaxRows][kMaxRows];  // J_i Mt^-1 J_j^T within the block, [j][i] with j < i
    double inverse_diagonal[kMaxRows];    // 1/(J_i Mt^-1 J_i^T + softness_i)
    double bias[kPadded];
    double softness[kPadded];
    double impulse[kPadded];
    double mass_a;  // 1/m of the bodies [1/kg]
    double mass_b;
    double mu;
    int a;
    int b;
    int rows;
    bool contact;
    bool pinned;
  };

  void pack(const System& system, bool warm_start);
  template <int Rows, bool Pinned>
  static void visit(Visit& block, std::span<Vec6> u);

  std::vector<Visit> visits_;
};

}  // namespace substep
