#include "app/cli/budget_flags.hpp"

#include "app/cli/within.hpp"

namespace substep::cli {

void BudgetFlags::add_to(CLI::App& command) {
  constexpr const char* kGroup = "Budget (past it the run stops and says what asked for more)";
  command
      .add_option("--memory-budget", mebibytes_,
                  "MiB that the direct solver may take; 512 where it is left out")
      ->check(within(kMemoryBudgetRange.least / kMebibyte, kMemoryBudgetRange.most / kMebibyte))
      ->group(kGroup);
  command
      .add_option("--work-budget", operations_,
                  "floating-point operations that a frame may take; 2e10 where it is left out")
      ->check(within(kWorkBudgetRange.least, kWorkBudgetRange.most))
      ->group(kGroup);
}

Budget BudgetFlags::budget() const { return {mebibytes_ * kMebibyte, operations_}; }

}  // namespace substep::cli
