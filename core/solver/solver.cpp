#include "core/solver/solver.hpp"

#include "core/solver/bpp.hpp"
#include "core/solver/pgs.hpp"

namespace substep {

std::unique_ptr<Solver> make_solver(SolverKind kind) {
  switch (kind) {
    case SolverKind::kPgs:
      return std::make_unique<Pgs>();
    case SolverKind::kBpp:
      return std::make_unique<Bpp>();
  }
  return nullptr;  // not reached: the switch is exhaustive
}

}  // namespace substep
