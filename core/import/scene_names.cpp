#include "core/import/scene_names.hpp"

#include <cctype>

#include "core/model/scene_limits.hpp"
#include "core/model/text_checks.hpp"

namespace substep {

std::string text_within(std::string_view text, std::size_t most) {
  std::string visible = visible_text(text.substr(0, most));
  if (visible.size() <= most) return visible;
  visible.resize(most);
  // A character of several bytes is not cut.
  return text_fault(visible) ? visible_text(text).substr(0, most / 8) : visible;
}

std::string identifier_of(std::string_view name) {
  std::string identifier;
  for (const char c : name.substr(0, kMaxNameSize)) {
    const bool is_digit = c >= '0' && c <= '9';
    const bool is_lower = c >= 'a' && c <= 'z';
    const bool is_upper = c >= 'A' && c <= 'Z';
    if (is_digit || is_lower || c == '_' || c == '-') {
      identifier += c;
    } else {
      identifier += is_upper ? static_cast<char>(c - 'A' + 'a') : '_';
    }
  }
  return identifier.empty() ? "model" : identifier;
}

UniqueNames::UniqueNames(std::string reserved) { taken_.insert(std::move(reserved)); }

std::string UniqueNames::unique(const std::string& wanted) {
  constexpr std::size_t kNumber = 12;  // room for "_" and a number
  const std::string base = text_within(wanted.empty() ? "unnamed" : wanted, kMaxNameSize - kNumber);
  std::string name = base;
  int& next = next_.emplace(base, 2).first->second;
  while (!taken_.insert(name).second) name = base + "_" + std::to_string(next++);
  return name;
}

}  // namespace substep
