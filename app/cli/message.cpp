#include "app/cli/message.hpp"

#include <cstdarg>
#include <string_view>

#include "core/model/format_text.hpp"

namespace substep::cli {

std::string visible_lines(std::string_view text) {
  std::string shown;
  for (;;) {
    const std::size_t end = text.find('\n');
    shown += visible_text(text.substr(0, end));
    if (end == std::string_view::npos) return shown;
    shown += '\n';
    text.remove_prefix(end + 1);
  }
}

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
