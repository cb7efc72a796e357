#pragma once

#include <atomic>
#include <string>

namespace substep::cli {

/// Sets the flag on the first SIGINT, SIGTERM or SIGHUP; those that were ignored when the program
/// started stay ignored. A command that is still running 0.12 s later, or at a second signal, is
/// ended with cancelled_code(). Outputs keep their data as set by Output::keep_if_ended, and one
/// that is being committed is completed first. A third signal gives this one second, because a disk
/// or a pipe may block for ever; then temporary files are removed and the program ends.
const std::atomic<bool>& cancel_on_signal();

/// Exit code of a cancelled program, as in the shells: 128 and the number of the first signal.
int cancelled_code();

/// Prints "cancelled" and what follows it on stderr, unless it was printed before.
void say_cancelled(const std::string& what = "");

}  // namespace substep::cli
