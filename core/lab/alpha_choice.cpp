#include "core/lab/alpha_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace substep {
namespace {

constexpr double kNarrow = 1.02;  // ratio of the ends of an interval that is not halved

using Tried = std::function<std::optional<AlphaChoice>(double)>;  // nothing where it was cancelled
using Serves = std::function<bool(const Result&)>;

Tried runs_of(const Scene& scene, const Experiment& experiment, const Reference& reference,
              const std::atomic<bool>& cancelled) {
  return [&](double alpha) -> std::optional<AlphaChoice> {
    Experiment own = experiment;
    own.settings.alpha = alpha;
    ExperimentRun run(scene, own, reference);
    while (run.advance()) {
      if (cancelled) return std::nullopt;
    }
    return AlphaChoice{alpha, run.result()};
  };
}

/// From 1 down by quarters, since small alphas are dear to try, to where an alpha first serves
/// (`from_above`) or no longer does; then by halves between the two.
std::optional<AlphaChoice> edge(const Tried& tried, const Serves& serves, bool from_above) {
  std::optional<AlphaChoice> good;
  double bad = 0.0;
  const auto take = [&](double alpha) {
    auto choice = tried(alpha);
    if (!choice) return false;
    if (serves(choice->result)) {
      good = std::move(choice);
    } else {
      bad = alpha;
    }
    return true;
  };
  for (double alpha = 1.0; from_above ? !good : bad == 0.0; alpha *= 0.25) {
    if (!take(std::max(alpha, kLeastAlpha))) return std::nullopt;
    if (alpha <= kLeastAlpha) break;
  }
  if (!good || bad == 0.0) return good;
  while (std::max(bad / good->alpha, good->alpha / bad) > kNarrow) {
    if (!take(std::sqrt(bad * good->alpha))) return std::nullopt;
  }
  return good;
}

}  // namespace

std::optional<AlphaChoice> largest_alpha_within(const Scene& scene, const Experiment& experiment,
                                                const Reference& reference, ErrorAxis axis,
                                                double error, const std::atomic<bool>& cancelled) {
  const auto serves = [&](const Result& result) {
    const auto value = error_of(result, axis);
    return value && *value <= error;
  };
  return edge(runs_of(scene, experiment, reference, cancelled), serves, true);
}

std::optional<AlphaChoice> smallest_alpha_within(const Scene& scene, const Experiment& experiment,
                                                 const Reference& reference, CostAxis axis,
                                                 double cost, const std::atomic<bool>& cancelled) {
  const auto serves = [&](const Result& result) { return cost_of(result, axis) <= cost; };
  return edge(runs_of(scene, experiment, reference, cancelled), serves, false);
}

}  // namespace substep
