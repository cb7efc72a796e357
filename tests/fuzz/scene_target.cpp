// A text as a scene file: either a scene or problems, and a scene is written, read back and run.

#include <memory>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/sim/simulator.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/frame_laws.hpp"

namespace substep::fuzz {
namespace {

constexpr std::size_t kMostBodies = 16;  // of scenes that are run: thousands of runs a second
constexpr int kFrames = 3;
constexpr int kSubsteps = 4;

void write_and_read_back(const Scene& scene) {
  const std::string written = write_scene(scene);
  const SceneResult again = read_scene(written);
  require(again.scene != nullptr, "a written scene can be read");
  require(write_scene(*again.scene) == written, "a written scene is read back bit for bit");
}

void run_for_a_moment(const std::shared_ptr<const Scene>& scene) {
  const Settings settings = test::shortened(scene->settings, kSubsteps);
  Simulator simulator(scene);
  simulator.set_settings(settings);
  for (int i = 0; i < kFrames; ++i) {
    const FrameReport report = simulator.step();
    const std::string law = test::broken_law(*scene, settings, simulator.state(), report);
    require(law.empty(), law);
    if (report.status != StepStatus::kOk) return;
  }
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace substep;
  const SceneResult read = read_scene(fuzz::text_of(data, size));
  fuzz::require((read.scene == nullptr) == !read.problems.empty(), "either a scene or problems");
  for (const Problem& problem : read.problems) {
    fuzz::require(!problem.message.empty(), "a problem has a message");
  }
  if (!read.scene) return 0;
  fuzz::write_and_read_back(*read.scene);
  if (read.scene->bodies.size() <= fuzz::kMostBodies) fuzz::run_for_a_moment(read.scene);
  return 0;
}
