#include "core/model/number_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/model/format_text.hpp"

namespace substep {

// Emscripten's library has no std::to_chars and std::from_chars for doubles: hence the C functions,
// which round correctly on every platform that we build for.

std::string number_text(double value) {
  if (value == 0.0) return std::signbit(value) ? "-0.0" : "0";  // JSON's "-0" is the integer 0
  std::array<char, 32> text{};
  // A decimal of up to 15 digits is unchanged by a round trip through a double.
  for (int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    if (std::strtod(text.data(), nullptr) == value) break;
  }
  std::string shortest = text.data();
  // "1e-08" to "1e-8", "1e+20" to "1e20".
  if (const std::size_t e = shortest.find('e'); e != std::string::npos) {
    if (shortest[e + 1] == '+') shortest.erase(e + 1, 1);
    const std::size_t first = shortest.find_first_of("0123456789", e);
    shortest.erase(first, shortest.find_first_not_of('0', first) - first);
  } else if (shortest.find('.') == std::string::npos) {
    // "1000000" to "1e6".
    const std::size_t zeros = shortest.size() - 1 - shortest.find_last_not_of('0');
    if (zeros > 5) {
      shortest.resize(shortest.size() - zeros);
      shortest += 'e';
      shortest += std::to_string(zeros);
    }
  }
  return shortest;
}

double three_digits(double value) {
  return std::strtod(format_text("%.3g", value).c_str(), nullptr);
}

std::optional<double> parse_number(std::string_view text) {
  // strtod also accepts leading spaces, hexadecimal, "inf" and "nan"; these are rejected here.
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return {};
  const std::string copy(text);
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace substep
