#pragma once

#include <cstddef>
#include <memory>

#include "core/solver/solver.hpp"

namespace substep {

/// Projected Gauss-Seidel (Erleben 2013, "Numerical methods for linear complementarity problems in
/// physics-based animation"), matrix-free: sequential impulses on u, row by row in the order of the
/// blocks, friction bounds updated continuously. A fixed number of iterations; impulses start from
/// zero or, with Settings::warm_start, from the seeds.
class Pgs final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks, bool loops) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;

 private:
  void pack(const System& system, bool warm_start, bool cone);

  /// Packed variable-length records of the blocks in visiting order (pgs.cpp: Visit), rebuilt in
  /// every sub-step.
  std::unique_ptr<std::byte[]> records_;
  std::size_t capacity_ = 0;  // [bytes]
};

}  // namespace substep
