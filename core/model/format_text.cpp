#include "core/model/format_text.hpp"

#include <cstdarg>
#include <cstdio>

namespace substep {

std::string format_text(const char* pattern, ...) {
  char buffer[1000];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, values);
  va_end(values);
  return buffer;
}

}  // namespace substep
