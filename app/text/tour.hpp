#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/run_loop.hpp"

namespace substep {

/// Feedback on a step's task from its run.
struct TourReply {
  std::string text;   // one sentence, or "" if there is none yet
  bool done = false;  // the task is completed
};

/// A step of the guided tour: an experiment and its explanation. The sentences contain markup:
/// "{alpha}" is an adjustable number of the run (TourNumber), "[the plot of N](substeps)" refers to
/// a place in the window (TourPlace).
struct TourStep {
  const char* title;
  const char* text;
  const char* watch;  // where to look
  const char* task;   // suggestion to try
  const char* link;   // the experiment, as links spell it
  RunLoop::Plan loop;
  TourReply (*reply)(const Lab& lab, const RunLoop::Outcome& outcome);
};

// Feedback on the tasks of the steps: computed from the last pass of the loop, without constants.
TourReply reply_lighter_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_break_it(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_lose_less(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_range_of_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_double_n(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_heavier_box(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_changing_load(const Lab& lab, const RunLoop::Outcome& outcome);
TourReply reply_half_the_substeps(const Lab& lab, const RunLoop::Outcome& outcome);

/// The scene of a step.
std::string_view scene_of(const TourStep& step);

/// The steps. Tests verify every number in them by simulation.
std::span<const TourStep> tour_steps();

/// A place in the window that a sentence refers to.
struct TourPlace {
  std::string_view name;   // in the markup
  std::string_view panel;  // its panel, as spelt in links
  std::string_view group;  // of its handle (app/ui/handles.hpp)
  std::string_view label;  // of its handle
};
std::span<const TourPlace> tour_places();

/// A fragment of a sentence.
struct TourPart {
  enum class Kind : unsigned char { kText, kNumber, kPlace };
  Kind kind = Kind::kText;
  std::string text;  // as displayed; empty for a number
  std::string name;  // of the number or the place
  friend bool operator==(const TourPart&, const TourPart&) = default;
};
/// The fragments of a sentence in order. Unclosed braces and brackets are plain text.
std::vector<TourPart> tour_parts(std::string_view sentence);

}  // namespace substep
