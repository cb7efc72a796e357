// Any valid scene stays finite or stops with a status, within its bounds of work. A few hundred
// scenes by default, always the same; RC_PARAMS="max_success=100000 seed=1" for an overnight run. A
// failure prints the seed that reproduces it.

#include "tests/hard/random_scenes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/frame_laws.hpp"

namespace substep::test {
namespace {

constexpr int kFrames = 6;

std::shared_ptr<const Scene> through_a_file(const Scene& scene) {
  const std::string text = write_scene(scene);
  SceneResult read = read_scene(text);
  for (const Problem& problem : read.problems) RC_LOG() << to_string(problem) << '\n';
  if (!read.scene) RC_LOG() << text;
  RC_ASSERT(read.scene != nullptr);
  return read.scene;
}

void run_by_the_laws(const std::shared_ptr<const Scene>& scene) {
  Simulator simulator(scene);
  for (int i = 0; i < kFrames; ++i) {
    const FrameReport report = simulator.step();
    const std::string law = broken_law(*scene, scene->settings, simulator.state(), report);
    if (!law.empty()) {
      RC_LOG() << "frame " << i << ", not so: " << law << '\n' << write_scene(*scene);
      RC_FAIL(law);
    }
    if (report.status != StepStatus::kOk) return;
  }
  // The result can be saved, unless positions or velocities exceed the limits of a scene.
  const Scene saved = saved_scene(*scene, simulator.state(), scene->settings);
  const SceneResult again = read_scene(write_scene(saved));
  RC_ASSERT(again.scene != nullptr || !again.problems.empty());
}

TEST(RandomScenes, RunFiniteOrStopWithAStatusWithinTheirBounds) {
  setenv("RC_PARAMS", "max_success=300 seed=7", 0);
  ASSERT_TRUE(rc::check([] { run_by_the_laws(through_a_file(any_scene())); }));
}

}  // namespace
}  // namespace substep::test
