#pragma once
// What is wrong with outside data, place by place.

#include <cstddef>
#include <string>
#include <vector>

namespace substep {

/// One thing wrong with outside data.
struct Problem {
  std::string pointer;  // JSON pointer to the place, "" for the whole document
  std::string message;  // value and allowed range: "must be above 0 (kg), not -1"
};
using Problems = std::vector<Problem>;

/// Told of one document. Readers stop at more, so that a hostile one does not use up memory.
inline constexpr std::size_t kMaxProblems = 1000;

/// "/bodies/3/mass: must be above 0 (kg), not -1"
std::string to_string(const Problem& problem);

}  // namespace substep
