#pragma once

namespace substep::cli {

/// Prints a line on standard error, like printf; the line feed is added. Control characters in what
/// it shows are escaped, so that no name, key or path can steer the terminal.
[[gnu::format(printf, 1, 2)]] void complain(const char* pattern, ...);

}  // namespace substep::cli
