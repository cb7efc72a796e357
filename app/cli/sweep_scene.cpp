#include "app/cli/sweep_scene.hpp"

#include <string>
#include <system_error>

#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"

namespace substep::cli {
namespace {

/// The physical content of the scene as text. Settings and duration are in the results.
std::string moving_part(Scene scene) {
  scene.title = scene.group = scene.description = scene.look_for = "";
  scene.settings = {};
  scene.recommended.reset();
  scene.verdicts = {};
  scene.camera = {};
  return write_scene(scene);
}

}  // namespace

bool keep_scene(const std::filesystem::path& folder, const Scene& scene) {
  const std::string path = (folder / "scene.json").string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return write_file(path, write_scene(scene));
  const SceneResult kept = read_scene_file(path);
  if (kept.scene && moving_part(*kept.scene) == moving_part(scene)) return true;
  complain("%s: the results in this folder are of another scene of this name; choose another --out",
           path.c_str());
  return false;
}

}  // namespace substep::cli
