#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/text/tour.hpp"

namespace substep {

/// A number in a sentence: a setting of the run, with the values that it may be set to.
struct TourNumber {
  std::string name;           // as links spell it: "n", "alpha", "load"
  std::string label;          // "Sub-steps per frame"
  double value = 0.0;         // in the unit that links have
  std::string text;           // as it is read: "1,000 kg"
  std::vector<double> stops;  // that a drag passes through, ascending
  bool from_start = false;    // a run that begins with it says more than one that changes to it
};
/// The value that the run has now. @param name one that tour_steps() uses
TourNumber tour_number(const Lab& lab, std::string_view name);

/// A step as it is shown now, for the card in the window and for the page.
struct TourWords {
  std::size_t step = 0;  // from 0
  std::size_t count = 0;
  std::string title;
  std::vector<TourPart> text;
  std::vector<TourPart> watch;
  std::vector<TourPart> task;
  std::vector<TourNumber> numbers;  // of these sentences
  std::string now;                  // clock and sub-steps of the runs
  TourReply reply;
};
TourWords tour_words(const Lab& lab, std::size_t step, const RunLoop& loop);

/// A sentence with its numbers as they are now.
std::string tour_sentence(const std::vector<TourPart>& parts,
                          const std::vector<TourNumber>& numbers);

}  // namespace substep
