#pragma once

#include <cstdio>
#include <cstdlib>

namespace substep {

/// The number of three significant digits next to this, as people read and type it.
inline double three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return std::strtod(text, nullptr);
}

}  // namespace substep
