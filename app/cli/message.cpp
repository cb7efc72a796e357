#include "app/cli/message.hpp"

#include <cstdarg>
#include <string>

#include "core/model/format_text.hpp"

namespace substep::cli {

void complain(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  const std::string text = vformat_text(pattern, values);
  va_end(values);
  std::fprintf(stderr, "%s\n", visible_text(text).c_str());
}

void say(std::FILE* file, const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  const std::string text = vformat_text(pattern, values);
  va_end(values);
  std::fputs(visible_lines(text).c_str(), file);
}

}  // namespace substep::cli
