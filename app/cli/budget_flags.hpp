#pragma once

#include <CLI/CLI.hpp>

#include "core/model/budget.hpp"

namespace substep::cli {

/// `--memory-budget` and `--work-budget` of a command that steps a scene.
class BudgetFlags {
 public:
  void add_to(CLI::App& command);
  [[nodiscard]] Budget budget() const;

 private:
  double mebibytes_ = Budget{}.memory / kMebibyte;
  double operations_ = Budget{}.work;
};

}  // namespace substep::cli
