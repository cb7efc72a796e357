#pragma once
// The exam in the window: its scenes in the library, and the exact motion over the picture.

#include <memory>

#include "app/lab/library.hpp"
#include "app/lab/session.hpp"
#include "core/lab/exam.hpp"

namespace substep {

/// Adds the exam's scenes to the shipped ones, as far as the vocabulary reaches them, with leapfrog
/// and 16 sub-steps a frame to begin with.
void add_exam(Library& library);

/// Where the bodies of an exam scene should be, at the time that the session is shown at.
class ExamGhost {
 public:
  /// Once a picture. @return nothing where the session runs no scene of the exam as it stands, or
  /// one without an exact motion
  const Poses* at(const Session& session);

 private:
  std::shared_ptr<const Scene> scene_;  // that motion_ was looked up for
  std::function<ExamMotion()> start_;
  ExamMotion motion_;
  double t_ = 0.0;  // of poses_ [s]
  Poses poses_;
};

}  // namespace substep
