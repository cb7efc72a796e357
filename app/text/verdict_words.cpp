#include "app/text/verdict_words.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "app/text/format.hpp"

namespace substep {

std::string verdict_words(const std::string& text) {
  using Words = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Words, 3> kWords{
      {{"holds", "Holds"}, {"fails at", "Failed at"}, {"disturbed", "Disturbed"}}};
  for (const auto& [judged, said] : kWords) {
    if (text.starts_with(judged)) return std::string(said) + text.substr(judged.size());
  }
  return text;
}

namespace {

std::string quantity(double value, Exceeded::What what) {
  if (what != Exceeded::What::kEnergyGain) return plain_number(value) + " m";
  const Unit unit = unit_for(value);
  return plain_number(value / unit.factor) + " " + unit.prefix + "J";
}

}  // namespace

std::string exceeded_label(const Exceeded& e) {
  const std::string value = quantity(e.value, e.what);
  switch (e.what) {
    case Exceeded::What::kJointGap:
      return "joint gap " + value;
    case Exceeded::What::kEnergyGain:
      return "energy gain " + value;
    case Exceeded::What::kMoved:
      return "moved " + value;
    case Exceeded::What::kOverlap:
      return "overlap " + value;
    case Exceeded::What::kPassage:
      return "passed through";
  }
  return "";
}

std::string exceeded_sentence(const Exceeded& e) {
  const std::string limit = quantity(e.limit, e.what);
  std::string value = quantity(e.value, e.what);
  if (value == limit) value = "just over " + limit;
  switch (e.what) {
    case Exceeded::What::kJointGap:
      return e.name + " has a gap of " + value + ". Above " + limit + " a joint counts as torn.";
    case Exceeded::What::kEnergyGain:
      return "The total energy has grown by " + value + ". The limit is " + limit + ".";
    case Exceeded::What::kMoved:
      return e.name + " has moved by " + value + ". The scene allows " + limit + ".";
    case Exceeded::What::kOverlap:
      return e.name + ": they overlap by " + value + ". Above " + limit +
             " bodies count as inside each other.";
    case Exceeded::What::kPassage:
      return e.name + ": they passed through each other between two frames.";
  }
  return "";
}

std::string verdict_note(const Verdict& verdict, bool judged) {
  if (!judged) return "Ready";
  return verdict.holds() ? "Holds" : "Failed at " + fixed(verdict.failed_at(), 2) + " s";
}

}  // namespace substep
