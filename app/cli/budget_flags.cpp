#include "app/cli/budget_flags.hpp"

#include "app/cli/within.hpp"

namespace substep::cli {

void BudgetFlags::add_to(CLI::App& command) {
  constexpr const char* kGroup = "Budget (a run that exceeds it stops and reports the reason)";
  command
      .add_option("--memory-budget", mebibytes_,
                  "maximum memory of the direct solver [MiB]; default 512")
      ->check(within(kMemoryBudgetRange.least / kMebibyte, kMemoryBudgetRange.most / kMebibyte))
      ->group(kGroup);
  command
      .add_option("--work-budget", operations_,
                  "maximum of floating-point operations per frame; default 2e10")
      ->check(within(kWorkBudgetRange.least, kWorkBudgetRange.most))
      ->group(kGroup);
}

Budget BudgetFlags::budget() const { return {mebibytes_ * kMebibyte, operations_}; }

}  // namespace substep::cli
