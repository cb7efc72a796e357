#include "app/cli/message.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "core/model/format_text.hpp"

namespace substep::cli {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The length of the UTF-8 character at the start of the text, 0 if it is invalid.
/// Overlong forms of control characters are rejected by their lead bytes.
std::size_t character_length(std::string_view text) {
  const unsigned lead = byte_at(text, 0);
  std::size_t length = 0;
  if (lead < 0x80U) return 1;
  if (lead >= 0xc2U && lead < 0xe0U) length = 2;
  if (lead >= 0xe0U && lead < 0xf0U) length = 3;
  if (lead >= 0xf0U && lead < 0xf5U) length = 4;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xc0U) != 0x80U) return 0;
  }
  if (lead == 0xe0U && byte_at(text, 1) < 0xa0U) return 0;  // overlong
  if (lead == 0xf0U && byte_at(text, 1) < 0x90U) return 0;
  return length;
}

bool is_control(std::string_view character) {
  const unsigned lead = byte_at(character, 0);
  if (character.size() == 1) return lead < 0x20U || lead == 0x7fU;
  return lead == 0xc2U && byte_at(character, 1) < 0xa0U;  // C1
}

}  // namespace

std::string visible_text(std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length > 0 && !is_control(character)) {
      shown += character;
    } else {
      for (std::size_t i = 0; i < character.size(); ++i) {
        const unsigned byte = byte_at(character, i);
        shown += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
      }
    }
    text.remove_prefix(character.size());
  }
  return shown;
}

void complain(const char* pattern, ...) {
  std::va_list values;
  va_start(values, pattern);
  const std::string text = vformat_text(pattern, values);
  va_end(values);
  std::fprintf(stderr, "%s\n", visible_text(text).c_str());
}

}  // namespace substep::cli
