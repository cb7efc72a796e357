#include "core/model/text_checks.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "core/model/format_text.hpp"

namespace substep {
namespace {

/// A character of UTF-8 with its bytes.
struct Character {
  char32_t code = 0;
  std::size_t size = 0;  // [bytes], 0 if they are invalid
};

unsigned byte_of(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The character at the start of a text that is not empty.
Character character_at_start(std::string_view text) {
  struct Form {
    unsigned mask, lead;
    char32_t least;  // smaller codes are overlong
  };
  static constexpr Form kForms[] = {
      {0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};
  const unsigned lead = byte_of(text, 0);
  const auto form = std::find_if(std::begin(kForms), std::end(kForms),
                                 [&](const Form& f) { return (lead & f.mask) == f.lead; });
  const auto size = static_cast<std::size_t>(form - std::begin(kForms)) + 1;
  if (form == std::end(kForms) || text.size() < size) return {};
  char32_t code = lead & ~form->mask;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte_of(text, i) & 0xc0U) != 0x80U) return {};
    code = (code << 6U) | (byte_of(text, i) & 0x3fU);
  }
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < form->least || surrogate || code > 0x10ffff) return {};
  return {code, size};
}

struct RefusedRange {
  char32_t first, last;
  const char* what;
};
constexpr const char* kControl = "a control character";
constexpr const char* kLine = "a line separator";
constexpr const char* kDirection = "a control of the direction of writing";
constexpr const char* kInvisible = "an invisible character";
constexpr RefusedRange kRefusedRanges[] = {
    {0x00, 0x1f, kControl},         {0x7f, 0x9f, kControl},          // C0, DEL, C1
    {0xad, 0xad, kInvisible},       {0x34f, 0x34f, kInvisible},      // soft hyphen, joiner
    {0x61c, 0x61c, kDirection},     {0x115f, 0x1160, kInvisible},    // mark, Hangul fillers
    {0x17b4, 0x17b5, kInvisible},   {0x180b, 0x180f, kInvisible},    // Khmer, Mongolian
    {0x200b, 0x200b, kInvisible},   {0x200e, 0x200f, kDirection},    // zero width space, marks
    {0x2028, 0x2029, kLine},        {0x202a, 0x202e, kDirection},    // separators, overrides
    {0x2060, 0x2065, kInvisible},   {0x2066, 0x2069, kDirection},    // word joiner, isolates
    {0x206a, 0x206f, kInvisible},   {0x3164, 0x3164, kInvisible},    // deprecated, Hangul filler
    {0xfeff, 0xfeff, kInvisible},   {0xffa0, 0xffa0, kInvisible},    // byte order mark, filler
    {0xfff0, 0xfffb, kInvisible},   {0xfffe, 0xffff, kInvisible},    // annotations, no character
    {0x1d173, 0x1d17a, kInvisible}, {0xe0000, 0xe0fff, kInvisible},  // musical, tags
};

bool is_joiner(char32_t code) { return code == 0x200c || code == 0x200d; }

/// What is wrong with a character, or null. @param before the one before it, 0 at the start
const char* fault_of(char32_t code, char32_t before) {
  if (is_joiner(code) && before < 0x80) return kInvisible;
  const auto found =
      std::find_if(std::begin(kRefusedRanges), std::end(kRefusedRanges),
                   [&](const RefusedRange& r) { return r.first <= code && code <= r.last; });
  return found == std::end(kRefusedRanges) ? nullptr : found->what;
}

}  // namespace

std::optional<std::string> text_fault(std::string_view text) {
  for (char32_t before = 0; !text.empty();) {
    const Character next = character_at_start(text);
    if (next.size == 0) return " is not valid UTF-8";
    if (const char* what = fault_of(next.code, before)) {
      return format_text(" has %s (U+%04X)", what, static_cast<unsigned>(next.code));
    }
    before = next.code;
    text.remove_prefix(next.size);
  }
  return std::nullopt;
}

std::string visible_text(std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string shown;
  for (char32_t before = 0; !text.empty();) {
    const Character next = character_at_start(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(next.size, 1));
    if (next.size > 0 && fault_of(next.code, before) == nullptr) {
      shown += bytes;
    } else {
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        const unsigned byte = byte_of(bytes, i);
        shown += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
      }
    }
    before = next.code;
    text.remove_prefix(bytes.size());
  }
  return shown;
}

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

}  // namespace substep
