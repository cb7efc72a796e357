#pragma once

#include "core/model/scene.hpp"

namespace substep {

/// Predicts how many sub-steps per frame per scene will need.
struct Forecast {
  double mass_ratio = 1.0;  // heaviest over lightest moving body [-]
  int at_start = 1;         // by Eq. 11 from the forces at the start, contacts included
  int hanging = 1;          // by Eq. 11 with every joint loaded by the weight hanging on it
  int body = -1;            // determines `hanging`; -1: none
  [[nodiscard]] int n() const { return at_start > hanging ? at_start : hanging; }
};

/// N of the scene at its start and in static equilibrium. A swing needs more at its lowest point
/// because of the centripetal force: sqrt(3) times when released at a right angle. Impacts are not
/// predicted.
///
/// The load of a joint is the weight of the part of the scene that it alone supports; in a loop,
/// half the weight of all joined bodies. A load along its arm r adds the stiffness load |r x e| to
/// rotation about e (Eq. 1), and r = k/I as in Eq. 9; one on a rod of length L the stiffness load/L
/// across it, and r = k/m.
Forecast forecast(const Scene& scene, const Settings& settings);

}  // namespace substep
