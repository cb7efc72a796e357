#pragma once

#include <string>

namespace substep::cli {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* pattern, ...);

}  // namespace substep::cli
