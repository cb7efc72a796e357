#pragma once

#include <atomic>

namespace substep::cli {

/// From now on Ctrl-C and a request to end set the flag once; whoever asks twice will not wait. A
/// command that has not ended 0.12 s later is ended, with exit code 130 and with what its outputs
/// say that they keep (Output::keep_if_ended).
const std::atomic<bool>& cancel_on_signal();

}  // namespace substep::cli
