#pragma once
// Common parts of the exam's cases.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/lab/exam.hpp"
#include "scenes/generator/parts.hpp"

namespace substep::scenes {

inline constexpr double kExamGravity = 9.81;  // [m/s^2]

/// A case and its empty scene with the paper's settings, with the same name and texts.
/// @param duration, frame [s]
inline ExamCase exam_case(const std::string& name, const std::string& title,
                          const std::string& definition, const std::string& source, double duration,
                          double frame) {
  ExamCase exam;
  exam.name = name;
  exam.title = title;
  exam.definition = definition;
  exam.source = source;
  exam.scene.name = "exam_" + name;  // shipped scenes have some of the same names
  exam.scene.title = title;
  exam.scene.group = "exam";
  exam.scene.description = definition;
  exam.scene.look_for = "Reference: " + source;
  exam.scene.frame = frame;
  exam.scene.criteria.duration = duration;
  exam.scene.settings = PaperSettings{};
  return exam;
}

/// The largest error so far; NaN counts as infinite.
inline void raise(double& error, double value) {
  error = std::isnan(value) ? std::numeric_limits<double>::infinity() : std::max(error, value);
}

/// Angle of the rotation from one orientation to another, in [0, pi] [rad].
inline double angle_between(const Quat& a, const Quat& b) {
  const Quat turn = a.conjugate() * b;
  return 2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

/// Velocity and angular velocity at the time of the poses, world.
inline Vec3 velocity_of(const State& state, int body) {
  return state.u_synchronised[index(body)].head<3>();
}
inline Vec3 angular_velocity_of(const State& state, int body) {
  return state.u_synchronised[index(body)].tail<3>();
}

/// Six digits of a motion of the size `scale`: the tolerance for an exact reference, because the
/// tables of other codes have as many digits.
inline double six_digits(double scale) { return 1e-6 * scale; }
inline constexpr const char* kSixDigits =
    "the reference is exact; six digits of the motion's size, as printed tables have";

}  // namespace substep::scenes
