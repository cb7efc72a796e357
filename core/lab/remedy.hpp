#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/lab/verdict.hpp"
#include "core/model/budget.hpp"
#include "core/model/scene.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A change of settings that may help a run that failed.
struct Remedy {
  std::string text;  // "a smaller alpha, 0.05"
  std::string why;   // the reason: "43 were required"; or ""
  Settings settings;
};

/// Suggestions, the most likely first: the implicit gyroscopic torque instead of the explicit one,
/// adaptive sub-steps if not used, a larger cap if it was reached, the direct solver instead of
/// Gauss-Seidel, the soft drift law for impacts on joints, a smaller alpha, the default settings.
/// For a gain of energy, an overlap or a passage the default settings come first, and a smaller
/// alpha is none. None has been tried. @param last the report of the failed frame @param exceeded
/// Verdict::exceeded()
/// @return empty if no setting would help
std::vector<Remedy> remedies(const Settings& settings, const FrameReport& last,
                             const std::optional<Exceeded>& exceeded);

/// How remedies are tried.
struct Trial {
  std::int64_t frames = 0;  // that must hold
  Budget budget = {};
  std::size_t enough = 2;  // remedies that hold
  double most_work = 3e6;  // of one remedy [sub-steps times bodies]; one that needs more is left
};

/// Tries remedies one after the other, each in a run of the scene from its start.
class RemedyTrials {
 public:
  RemedyTrials(std::shared_ptr<const Scene> scene, std::vector<Remedy> remedies,
               const Trial& trial);
  ~RemedyTrials();
  RemedyTrials(RemedyTrials&&) noexcept;
  RemedyTrials& operator=(RemedyTrials&&) noexcept;

  /// Takes a frame of a trial, or a part of it. @return false when done
  bool advance();
  /// Those that held for all frames, so far.
  [[nodiscard]] const std::vector<Remedy>& hold() const { return hold_; }
  /// Number that do not hold, so far; those that need too much work are not counted.
  [[nodiscard]] int failed() const { return failed_; }
  [[nodiscard]] bool done() const;
  [[nodiscard]] const Trial& trial() const { return trial_; }

 private:
  struct Run;
  std::shared_ptr<const Scene> scene_;
  std::vector<Remedy> remedies_;
  Trial trial_;
  std::size_t next_ = 0;      // remedy to try
  std::unique_ptr<Run> run_;  // of the remedy before it, while it runs
  std::vector<Remedy> hold_;
  int failed_ = 0;
};

}  // namespace substep
