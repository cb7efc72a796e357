#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/text/tour.hpp"

namespace substep {

/// A number in a sentence: a setting of the run, with its allowed values.
struct TourNumber {
  std::string name;           // key in links: "n", "alpha", "load"
  std::string label;          // "Sub-steps per frame"
  double value = 0.0;         // in the unit of links
  std::string text;           // as displayed: "1,000 kg"
  std::vector<double> stops;  // values for dragging, ascending
  bool from_start = false;    // restart the run when the value changes
};
/// The current value in the run. @param name as used in tour_steps()
TourNumber tour_number(const Lab& lab, std::string_view name);

/// The current content of a step, for the card in the window and for the page.
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

/// A sentence as plain text with its current numbers.
std::string tour_sentence(const std::vector<TourPart>& parts,
                          const std::vector<TourNumber>& numbers);

}  // namespace substep
