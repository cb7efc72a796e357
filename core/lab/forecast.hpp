#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// Predicts how many sub-steps per frame a scene will need.
struct Forecast {
  double mass_ratio = 1.0;  // heaviest over lightest moving body [-]
  int at_start = 1;         // by Eq. 11 from the forces at the start, contacts included
  int hanging = 1;          // by Eq. 11 where every joint carries the weight that hangs on it
  int body = -1;            // that needs most of `hanging`; -1: none
  [[nodiscard]] int n() const { return at_start > hanging ? at_start : hanging; }
};

/// N of the scene as it starts and as it hangs still. A swing asks for more at its bottom, where
/// centripetal force comes on top: sqrt(3) times from a right angle. Impacts are not foretold.
///
/// Of a joint that alone holds a part of the scene, the load is that part's weight; where a loop
/// holds it, half the weight of all that is joined together. A load at an arm r along it stiffens
/// turning about e by load |r x e| (Eq. 1), and r = k/I as in Eq. 9.
Forecast forecast(const Scene& scene, const Settings& settings);

}  // namespace substep
