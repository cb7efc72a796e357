#pragma once

#include <cstdio>
#include <cstdlib>

namespace substep {

/// The nearest number with three significant digits.
inline double three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return std::strtod(text, nullptr);
}

}  // namespace substep
