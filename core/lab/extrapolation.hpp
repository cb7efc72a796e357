#pragma once
// Gragg, Bulirsch and Stoer: the modified midpoint rule with 2, 4, ..., 16 sub-steps, extrapolated
// to zero step length, has order 16 and an error estimate. For exact references, not for
// simulations.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/types.hpp"

namespace substep {

class Extrapolation {
 public:
  using Vector = VecX;

  /// @param tolerance of one step, relative to 1 + |y| [-]
  explicit Extrapolation(double tolerance) : tolerance_(tolerance) {}

  /// y(t + span) from y(t) for y' = f(y), with steps chosen by the tolerance.
  /// @param f writes y' into its second argument
  template <class F>
  void advance(const F& f, double span, Vector& y) {
    double left = span;
    while (left > kRounding * span) left -= attempt(f, left, y);
  }

  /// One attempt at a step, for callers that must return between steps: 2 + 4 + ... + 16
  /// evaluations of f. @param most the longest step [s] @return time advanced [s]; 0 if the error
  /// was too large, then the next attempt is shorter
  template <class F>
  double attempt(const F& f, double most, Vector& y) {
    const double step = std::min(length_, most);
    const double error = try_step(f, step, y);
    // The error of the last but one column scales with the 15th power of the step. The 16th root is
    // good enough, and bitwise reproducible.
    const double factor = 0.9 / std::sqrt(std::sqrt(std::sqrt(std::sqrt(std::max(error, 1e-8)))));
    if (error > 1.0) {
      length_ = step * std::clamp(factor, 0.1, 0.7);
      return 0.0;
    }
    y.swap(table_.back());
    if (step == length_) length_ *= std::min(factor, 2.0);
    return step;
  }

  static constexpr double kRounding = 1e-15;  // relative remainder of a span treated as zero [-]

 private:
  static constexpr int kColumns = 8;

  /// Extrapolates one step into the last column. @return its error, 1 at the tolerance
  template <class F>
  double try_step(const F& f, double step, const Vector& y) {
    f(y, slope_at_start_);
    double error = 0.0;
    for (int j = 0; j < kColumns; ++j) {
      Vector estimate = midpoint(f, step, 2 * (j + 1), y);
      // Aitken and Neville in the square of the sub-step; only the last row of the table is stored.
      for (int k = 0; k < j; ++k) {
        const double ratio = static_cast<double>(j + 1) / static_cast<double>(j - k);
        const Vector next = estimate + (estimate - table_[column(k)]) / (ratio * ratio - 1.0);
        table_[column(k)].swap(estimate);
        if (k + 1 == j) error = scaled((next - table_[column(k)]), y);
        estimate = next;
      }
      table_[column(j)] = estimate;
    }
    return std::isfinite(error) ? error : 1e8;
  }

  template <class F>
  Vector midpoint(const F& f, double step, int n, const Vector& y) {
    const double dt = step / n;
    Vector before = y;
    Vector now = y + dt * slope_at_start_;
    for (int i = 1; i < n; ++i) {
      f(now, slope_);
      before += 2.0 * dt * slope_;
      before.swap(now);
    }
    f(now, slope_);
    return 0.5 * (before + now + dt * slope_);  // Gragg's smoothing
  }

  [[nodiscard]] double scaled(const Vector& error, const Vector& y) const {
    return (error.array().abs() / (tolerance_ * (1.0 + y.array().abs()))).maxCoeff();
  }
  static std::size_t column(int k) { return static_cast<std::size_t>(k); }

  double tolerance_;
  double length_ = 1e-3;  // of the next step [s]
  std::array<Vector, kColumns> table_;
  Vector slope_;
  Vector slope_at_start_;
};

}  // namespace substep
