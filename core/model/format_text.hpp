#pragma once

#include <cstdarg>
#include <string>

namespace substep {

/// printf and vprintf into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* pattern, ...);
[[gnu::format(printf, 1, 0)]] std::string vformat_text(const char* pattern, std::va_list values);

}  // namespace substep
