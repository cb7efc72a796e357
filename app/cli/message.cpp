#include "app/cli/message.hpp"

#include <cstdarg>
#include <cstdio>

#include "app/cli/visible_text.hpp"

namespace substep::cli {
namespace {

[[gnu::format(printf, 1, 0)]] std::string formatted(const char* pattern, std::va_list values) {
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, pattern, values);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

}  // namespace

std::string format_text(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  std::string text = formatted(pattern, values);
  va_end(values);
  return text;
}

void complain(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  const std::string text = formatted(pattern, values);
  va_end(values);
  std::fprintf(stderr, "%s\n", visible_text(text).c_str());
}

}  // namespace substep::cli
