#pragma once
// A run that continues from a state, or from a saved scene, takes the same steps bit for bit.

#include <gtest/gtest.h>

#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "tests/support/run.hpp"

namespace substep::test {

/// Continues a run, a copy of its state, and its saved scene side by side.
inline void expect_continues(Simulator& whole, int frames) {
  Simulator rest = simulator_of(whole.scene(), whole.settings());
  rest.set_state(whole.state());
  const Scene saved = saved_scene(whole.scene(), whole.state(), whole.settings());
  SceneResult read = read_scene(write_scene(saved));
  for (const Problem& problem : read.problems) ADD_FAILURE() << to_string(problem);
  Simulator reopened(read.scene);
  for (int i = 0; i < frames; ++i) {
    whole.step();
    rest.step();
    reopened.step();
    ASSERT_EQ(state_hash(whole.state()), state_hash(rest.state())) << i;
    for (std::size_t body = 0; body < whole.state().x.size(); ++body) {
      ASSERT_EQ(whole.state().x[body], reopened.state().x[body]) << i;
      ASSERT_EQ(whole.state().u[body], reopened.state().u[body]) << i;
    }
  }
}

}  // namespace substep::test
