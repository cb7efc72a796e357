#pragma once

#include "core/model/problem.hpp"

namespace substep {

/// Invalid inputs that a simulator rejected, by source. Each list is cleared when a valid input of
/// the same kind is set.
struct Refused {
  Problems scene;  // permanent: the scene cannot be replaced
  Problems state;
  Problems settings;
  Problems grab;
  Problems budget;

  [[nodiscard]] bool any() const {
    return !scene.empty() || !state.empty() || !settings.empty() || !grab.empty() ||
           !budget.empty();
  }
  [[nodiscard]] Problems all() const {
    Problems sum;
    for (const Problems* some : {&scene, &state, &settings, &grab, &budget}) {
      sum.insert(sum.end(), some->begin(), some->end());
    }
    return sum;
  }
};

}  // namespace substep
