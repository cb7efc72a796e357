#pragma once
// The settings of scenes that choose none, and of the preset `steady`.

#include "tests/support/paper_settings.hpp"

namespace substep::test {

inline Settings steady() { return substep::Settings{}; }

/// @param n constant number of sub-steps; 0: adaptive
inline Settings steady_at(int n) {
  Settings settings = steady();
  if (n == 0) return settings;
  settings.mode = Mode::kConst;
  settings.n = n;
  return settings;
}

}  // namespace substep::test
