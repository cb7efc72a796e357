#include "app/text/verdict_words.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "app/text/format.hpp"

namespace substep {

std::string verdict_words(const std::string& text) {
  using Words = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Words, 3> kWords{
      {{"holds", "Stable"}, {"fails at", "Failed at"}, {"disturbed", "Disturbed"}}};
  for (const auto& [judged, said] : kWords) {
    if (text.starts_with(judged)) return std::string(said) + text.substr(judged.size());
  }
  return text;
}

std::string verdict_note(const Verdict& verdict, bool judged) {
  if (!judged) return "Ready";
  return verdict.holds() ? "Stable" : "Failed at " + fixed(verdict.failed_at(), 2) + " s";
}

}  // namespace substep
