#include "core/import/xml_numbers.hpp"

#include <algorithm>

#include "core/model/number_text.hpp"

namespace substep {

std::optional<std::vector<double>> numbers_of(std::string_view text, std::size_t most) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<double> numbers;
  for (std::size_t start = text.find_first_not_of(kBlanks); start != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, start), text.size());
    const std::optional<double> number = parse_number(text.substr(start, end - start));
    if (!number || numbers.size() == most) return std::nullopt;
    numbers.push_back(*number);
    start = text.find_first_not_of(kBlanks, end);
  }
  return numbers;
}

}  // namespace substep
