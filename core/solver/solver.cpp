#include "core/solver/solver.hpp"

#include "core/solver/bpp.hpp"
#include "core/solver/newton.hpp"
#include "core/solver/pgs.hpp"
#include "core/solver/xpbd.hpp"

namespace substep {

std::unique_ptr<Solver> make_solver(SolverKind kind) {
  switch (kind) {
    case SolverKind::kPgs:
      return std::make_unique<Pgs>();
    case SolverKind::kBpp:
      return std::make_unique<Bpp>();
    case SolverKind::kXpbd:
      return std::make_unique<Xpbd>();
    case SolverKind::kNewton:
      return std::make_unique<Newton>();
    case SolverKind::kCount:
      break;
  }
  return nullptr;  // not reached: the switch is exhaustive
}

}  // namespace substep
