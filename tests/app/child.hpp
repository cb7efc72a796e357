#pragma once

#include <filesystem>
#include <string>

#include "tests/app/hostile_input.hpp"

namespace substep {

/// How a call ended, and its time and memory.
struct Ending {
  int exit_code = -1;  // -1: ended by a signal
  int signal = 0;
  bool hung = false;         // it had to be killed
  bool interrupted = false;  // interrupted, as the input requests or after a timeout
  double seconds = 0.0;      // to its end, or from the interruption
  std::size_t memory = 0;    // peak memory [bytes]
  std::string out;           // its first 64 MiB
  std::string err;
};

/// Runs `program` with the input's arguments in the folder, which already has its files. After
/// `patience` [s] it is interrupted; after the same time again, it is killed.
Ending run_child(const std::string& program, const HostileInput& input,
                 const std::filesystem::path& folder, double patience);

}  // namespace substep
