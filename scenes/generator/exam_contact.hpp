#pragma once
// Common parts of the exam's contact cases, and their closed forms.

#include <vector>

#include "core/lab/exam.hpp"

namespace substep::scenes {

/// The exam's methods without a check of their order, which is undefined when contacts open and
/// close, and Gauss-Seidel with 100 sweeps.
/// @param n sub-steps per frame, ascending
std::vector<ExamMethod> contact_methods(const Settings& base, const std::vector<double>& n);

/// SimBenchmark's rolling test: constant accelerations along the force [m/s^2].
struct RollingAccelerations {
  double box = 0.0;
  double ball = 0.0;
};
RollingAccelerations rolling_accelerations();

/// A ball that falls onto a lossless linear spring.
struct SpringBounce {
  double mass = 1.0;       // [kg]
  double stiffness = 1.0;  // of the ground [N/m]
  double height = 1.0;     // of the gap at the start, at rest [m]
  double gravity = 9.81;   // [m/s^2]

  [[nodiscard]] double flight() const;               ///< from the ground up and down again [s]
  [[nodiscard]] double contact() const;              ///< time on the ground [s]
  [[nodiscard]] double gap_after(double t) const;    ///< negative: the spring is compressed [m]
  [[nodiscard]] int bounces_within(double t) const;  ///< deepest points passed
};

}  // namespace substep::scenes
