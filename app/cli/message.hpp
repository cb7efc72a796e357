#pragma once

#include <string>
#include <string_view>

namespace substep::cli {

/// Escapes every byte that could control a terminal, as in "\x1b": control characters (C0, DEL and
/// C1) and invalid UTF-8. The rest is unchanged. For messages that contain external names, keys and
/// paths.
std::string visible_text(std::string_view text);

/// Prints a line on standard error, like printf; adds the line feed. The line is visible_text().
[[gnu::format(printf, 1, 2)]] void complain(const char* pattern, ...);

}  // namespace substep::cli
