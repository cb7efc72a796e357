#pragma once

#include "core/model/settings.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {

/// Settings that all differ from their defaults.
inline Settings unusual() {
  Settings s;
  s.solver = SolverKind::kPgs;
  s.iterations = 31;
  s.share_iterations = true;
  s.warm_start = true;
  s.forces = Forces::kMean;
  s.refinements = 2;
  s.pivots = 7;
  s.mode = Mode::kCapped;
  s.alpha = 0.1 / 3.0;
  s.n = 9;
  s.n_max = 99;
  s.n_cap = 5;
  s.alpha_m = 0.6;
  s.beta = 0.9;
  s.policy = Policy::kSubstep;
  s.memory = 0.8;
  s.hold = 12;
  s.redo = true;
  s.islands = true;
  s.sleep = true;
  s.probe = false;
  s.integrator = Integrator::kLeapfrog;
  s.gyroscopic = Gyroscopic::kExplicit;
  s.drift = Drift::kFull;
  s.drift_tau = 0.001;
  s.drift_order = 2;
  s.detection = Detection::kFrame;
  s.contact_stiffness = ContactStiffness::kExact;
  s.rotation_criterion = false;
  s.friction_cone = FrictionCone::kCone;
  return s;
}

}  // namespace substep::test
