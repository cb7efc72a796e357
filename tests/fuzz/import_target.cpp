// A text as a model in MJCF, URDF or SLRBS, which includes itself: either a scene or errors, and a
// scene is valid, is written and read back.

#include "core/import/import_model.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"
#include "tests/fuzz/target.hpp"

namespace substep::fuzz {
namespace {

constexpr std::size_t kMostBodies = 16;  // of scenes that are run

void check(const std::string& text, const ImportOptions& options) {
  const ModelFiles files = [&](const std::string& name) -> std::optional<std::string> {
    if (name != "self") return std::nullopt;
    return text;
  };
  const ImportResult result = import_model(text, "model", files, options);
  require((result.scene == nullptr) == !result.report.errors.empty(), "either a scene or errors");
  for (const ImportNote& note : result.report.errors.notes) {
    require(!note.text.empty(), "an error has a text");
  }
  if (result.scene == nullptr) return;
  require(validate(*result.scene).empty(), "the scene is valid");
  const std::string written = write_scene(*result.scene);
  const SceneResult again = read_scene(written);
  for (const Problem& problem : again.problems) {
    std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  }
  require(again.scene != nullptr, "a written scene can be read");
  require(write_scene(*again.scene) == written, "a written scene is read back bit for bit");
  if (result.scene->bodies.size() > kMostBodies) return;
  Simulator simulator(result.scene);
  require(simulator.problems().empty(), "a simulator takes the scene");
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace substep;
  const std::string text = fuzz::text_of(data, size);
  fuzz::check(text, {});
  fuzz::check(text, {.key = "1", .collide = true, .free_root = true});
  return 0;
}
