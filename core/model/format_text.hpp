#pragma once

#include <string>

namespace substep {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* pattern, ...);

}  // namespace substep
