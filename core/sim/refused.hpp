#pragma once

#include "core/model/problem.hpp"

namespace substep {

/// What a simulator was given and did not take, by where it came from: each is cleared when
/// something valid is given in its place.
struct Refused {
  Problems scene;  // stays: there is no other
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
