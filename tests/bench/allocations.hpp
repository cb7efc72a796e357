#pragma once

#include <cstdint>

namespace substep::bench {

/// Calls of operator new since the program began, by any thread.
std::int64_t allocations();

}  // namespace substep::bench
