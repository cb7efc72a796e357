#pragma once

#include <atomic>

namespace substep::cli {

/// Sets the flag on the first SIGINT or SIGTERM; a second one ends the program at once. A command
/// that is still running 0.12 s later is ended with exit code 130; outputs keep their data as set
/// by Output::keep_if_ended.
const std::atomic<bool>& cancel_on_signal();

}  // namespace substep::cli
