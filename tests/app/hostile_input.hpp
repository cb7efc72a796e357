#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace substep {

/// One call of the command line that means no good, in a folder of its own.
struct HostileInput {
  std::vector<std::pair<std::string, std::string>> files;  // name in the folder, and text
  std::vector<std::string> arguments;
  std::string standard_input = "/dev/null";  // a path; "": closed
  bool output_is_full = false;               // standard output is /dev/full
  bool output_is_closed = false;
  std::size_t most_file = 0;  // no file may grow beyond this [bytes]; 0: no limit
  bool may_be_long = false;   // it may ask for hours of simulated time
  int interrupted_after = 0;  // a SIGINT is sent then [ms]; 0: none

  /// Whether the world takes less than the program wants to give.
  [[nodiscard]] bool hampered() const {
    return output_is_full || output_is_closed || most_file > 0;
  }
};

/// The same for the same seed.
HostileInput hostile_input(std::uint64_t seed);

/// The call as a person would write it, control characters escaped.
std::string in_words(const HostileInput& input);

}  // namespace substep
