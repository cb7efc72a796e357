#pragma once
// Printing for people. Text that comes from a file or from the command line cannot control the
// terminal.

#include <cstdio>

#include "core/model/text_checks.hpp"

namespace substep::cli {

/// Prints a line on standard error, like printf; adds the line feed. The line is visible_text().
[[gnu::format(printf, 1, 2)]] void complain(const char* pattern, ...);

/// Prints on a file, like fprintf: visible_lines(). A path, or another text that may have line
/// feeds of its own, needs visible_text() before.
[[gnu::format(printf, 2, 3)]] void say(std::FILE* file, const char* pattern, ...);

}  // namespace substep::cli
