#pragma once
// Runs sliced computations to their end.

#include "scenes/generator/scenes.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {

/// Until the sweep is done.
inline void finish(Headless& h) {
  h.app->session.pause();
  for (int i = 0; i < 20000 && h.app->accuracy.running(); ++i) h.frames(1);
}

/// Until the costs of effects are measured.
inline void finish_costs(Headless& h) {
  for (int i = 0; i < 20000 && h.app->accuracy.effects.running(); ++i) h.frames(1);
}

/// Three links under a heavy box, for half a second: quick, and bodies of different mass.
inline void sweep_a_rope(Headless& h) {
  Scene scene = scenes::rope_of_n({.n = 3});
  scene.criteria.duration = 0.5;
  h.app->run(std::make_shared<const Scene>(std::move(scene)));
  h.app->set("panel", "accuracy");
  h.app->set("accuracy", "run");
  finish(h);
}

}  // namespace substep
