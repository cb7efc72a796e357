#pragma once
// The exam in the window: its scenes in the library, and the exact motion over the picture.

#include <memory>

#include "app/lab/library.hpp"
#include "app/lab/session.hpp"
#include "core/lab/exam.hpp"

namespace substep {

/// Adds the exam's scenes that the scene format can express, with leapfrog and 16 sub-steps per
/// frame.
void add_exam(Library& library);

/// The exact poses of an exam scene at the time that the session shows.
class ExamGhost {
 public:
  /// Call once per drawn frame. @return null unless the session runs an unmodified exam scene with
  /// an exact motion
  const Poses* at(const Session& session);

 private:
  std::shared_ptr<const Scene> scene_;  // for which motion_ was looked up
  std::function<ExamMotion()> start_;
  ExamMotion motion_;
  double t_ = 0.0;  // of poses_ [s]
  Poses poses_;
};

}  // namespace substep
