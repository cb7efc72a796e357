#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace substep {

/// One hostile call of the command line, in its own folder.
struct HostileInput {
  std::vector<std::pair<std::string, std::string>> files;  // name in the folder, and text
  std::vector<std::string> arguments;
  std::string standard_input = "/dev/null";  // a path; "": closed
  bool output_is_full = false;               // standard output is /dev/full
  bool output_is_closed = false;
  std::size_t most_file = 0;  // file size limit [bytes]; 0: none
  bool may_be_long = false;   // it may request hours of simulated time
  int interrupted_after = 0;  // time at which SIGINT is sent [ms]; 0: none

  /// Whether the environment may reject the program's output.
  [[nodiscard]] bool hampered() const {
    return output_is_full || output_is_closed || most_file > 0;
  }
};

/// Deterministic for a seed.
HostileInput hostile_input(std::uint64_t seed);

/// The call as a shell command, control characters escaped.
std::string in_words(const HostileInput& input);

}  // namespace substep
