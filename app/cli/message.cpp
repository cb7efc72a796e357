#include "app/cli/message.hpp"

#include <cstdarg>
#include <cstdio>
#include <string>

#include "app/cli/visible_text.hpp"

namespace substep::cli {

void complain(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, pattern, values);
  va_end(values);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  std::fprintf(stderr, "%s\n", visible_text(text).c_str());
}

}  // namespace substep::cli
