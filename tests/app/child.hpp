#pragma once

#include <filesystem>
#include <string>

#include "tests/app/hostile_input.hpp"

namespace substep {

/// How a call ended, and what it took.
struct Ending {
  int exit_code = -1;  // -1: by a signal
  int signal = 0;
  bool hung = false;         // it had to be killed
  bool interrupted = false;  // it was told to end, as the input says or because it took long
  double seconds = 0.0;      // to its end, or from the interruption
  std::size_t memory = 0;    // the most it had at a time [bytes]
  std::string out;           // its first 64 MiB
  std::string err;
};

/// Runs `program` with the input's arguments in the folder, where its files are already. After
/// `patience` [s] it is interrupted; where it then goes on for as long again, it is killed.
Ending run_child(const std::string& program, const HostileInput& input,
                 const std::filesystem::path& folder, double patience);

}  // namespace substep
