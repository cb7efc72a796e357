#pragma once
// Allowed ranges of numbers, and the messages for violations.

#include <limits>
#include <string>
#include <string_view>

#include "core/model/number_text.hpp"

namespace substep {

struct Range {
  double least = -std::numeric_limits<double>::infinity();  // [unit]
  double most = std::numeric_limits<double>::infinity();    // [unit]
  bool open_below = false;                                  // least itself is not allowed
  bool open_above = false;                                  // most itself is not allowed
  std::string_view unit = "-";

  [[nodiscard]] bool above_least(double x) const { return open_below ? x > least : x >= least; }
  [[nodiscard]] bool below_most(double x) const { return open_above ? x < most : x <= most; }
  [[nodiscard]] bool contains(double x) const { return above_least(x) && below_most(x); }

  /// "above 0 (s)" or "at most 1e12 (kg)": the bound that x violates.
  [[nodiscard]] std::string violated_by(double x) const {
    return (above_least(x) ? upper() : lower()) + unit_text();
  }
  /// "from 1e-6 to 10 (s)", or "above 0 and at most 1" if an end is open: the allowed range.
  [[nodiscard]] std::string text() const {
    const bool closed = !open_below && !open_above;
    return (closed ? "from " + number_text(least) + " to " + number_text(most)
                   : lower() + " and " + upper()) +
           unit_text();
  }
  /// " (kg)", or nothing for a number without a unit.
  [[nodiscard]] std::string unit_text() const {
    return unit == "-" ? "" : " (" + std::string(unit) + ")";
  }

 private:
  [[nodiscard]] std::string lower() const {
    return (open_below ? "above " : "at least ") + number_text(least);
  }
  [[nodiscard]] std::string upper() const {
    return (open_above ? "below " : "at most ") + number_text(most);
  }
};

/// > 0 and <= most
constexpr Range positive(double most, std::string_view unit) {
  return {0.0, most, true, false, unit};
}
/// >= 0 and <= most
constexpr Range not_negative(double most, std::string_view unit) {
  return {0.0, most, false, false, unit};
}
/// >= -most and <= most
constexpr Range symmetric(double most, std::string_view unit) {
  return {-most, most, false, false, unit};
}

}  // namespace substep
