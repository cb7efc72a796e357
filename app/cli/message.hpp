#pragma once

#include <string>

namespace substep::cli {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* pattern, ...);

/// Prints a line on standard error, like printf; adds the line feed. Escapes control characters, so
/// that names, keys and paths cannot control the terminal.
[[gnu::format(printf, 1, 2)]] void complain(const char* pattern, ...);

}  // namespace substep::cli
