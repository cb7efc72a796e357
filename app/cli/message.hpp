#pragma once

namespace substep::cli {

/// Prints a line on standard error, like printf; adds the line feed. Escapes control characters, so
/// that names, keys and paths cannot control the terminal.
[[gnu::format(printf, 1, 2)]] void complain(const char* pattern, ...);

}  // namespace substep::cli
