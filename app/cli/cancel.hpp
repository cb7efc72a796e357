#pragma once

#include <atomic>

namespace substep::cli {

/// From now on Ctrl-C and a request to end set a flag once; whoever asks twice will not wait.
const std::atomic<bool>& cancel_on_signal();

}  // namespace substep::cli
