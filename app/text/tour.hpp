#pragma once

#include <span>

namespace substep {

/// One stop of the guided tour: an experiment, and what it shows.
struct TourStep {
  const char* title;
  const char* text;   // two sentences
  const char* watch;  // where to look
  const char* link;   // the experiment, as links spell it
};

/// The paper's story in six steps. Every number in it is tested by running.
std::span<const TourStep> tour_steps();

}  // namespace substep
