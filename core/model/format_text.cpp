#include "core/model/format_text.hpp"

#include <cstdio>

namespace substep {

std::string vformat_text(const char* pattern, std::va_list values) {
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, pattern, values);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

std::string format_text(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  std::string text = vformat_text(pattern, values);
  va_end(values);
  return text;
}

}  // namespace substep
