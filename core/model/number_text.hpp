#pragma once
// Numbers as text, and back.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace substep {

/// The shortest decimal text that reads back to the same double. Not for NaN and infinity.
std::string number_text(double value);

/// The nearest number with three significant digits.
double three_digits(double value);

/// The whole text as a finite double, or nothing.
std::optional<double> parse_number(std::string_view text);

/// The whole text as an integer in decimal, or nothing.
std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace substep
