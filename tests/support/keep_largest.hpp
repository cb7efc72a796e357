#pragma once

#include <cmath>

namespace substep {

/// Keeps the largest value so far. NaN counts as the largest, whereas std::max() ignores it.
inline void keep_largest(double& most, double value) {
  if (!std::isnan(most) && !(value <= most)) most = value;
}

}  // namespace substep
