#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/run_loop.hpp"

namespace substep {

/// What the run of a step answers to its task.
struct TourReply {
  std::string text;   // one sentence, or "" while there is nothing to say
  bool done = false;  // the task is
};

/// One stop of the guided tour: an experiment, and what it shows. Its sentences are marked up:
/// "{alpha}" is a number of the run that can be changed (TourNumber), "[the plot of N](substeps)"
/// points at a place in the window (TourPlace).
struct TourStep {
  const char* title;
  const char* text;
  const char* watch;  // where to look
  const char* task;   // what to try, or ""
  const char* link;   // the experiment, as links spell it
  RunLoop::Plan loop;
  TourReply (*reply)(const Lab& lab, const RunLoop::Outcome& outcome);
};

/// Of every step.
inline constexpr std::string_view kTourScene = "swinging_box";

/// The paper's story. Every number in it is tested by running.
std::span<const TourStep> tour_steps();

/// A place in the window that a sentence points at.
struct TourPlace {
  std::string_view name;   // in the markup
  std::string_view panel;  // that it is in, as links spell it
  std::string_view group;  // of its handle (app/ui/handles.hpp)
  std::string_view label;  // of its handle
};
std::span<const TourPlace> tour_places();

/// A piece of a sentence.
struct TourPart {
  enum class Kind : unsigned char { kText, kNumber, kPlace };
  Kind kind = Kind::kText;
  std::string text;  // as it is read; of a number, empty
  std::string name;  // of the number or the place
  friend bool operator==(const TourPart&, const TourPart&) = default;
};
/// The pieces of a sentence in order. Braces and brackets that are not closed are text.
std::vector<TourPart> tour_parts(std::string_view sentence);

}  // namespace substep
