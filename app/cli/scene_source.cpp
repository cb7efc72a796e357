#include "app/cli/scene_source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "app/cli/bounded_text.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "core/import/import_model.hpp"
#include "core/io/json_text.hpp"
#include "core/io/object_reader.hpp"
#include "core/io/scene_reader.hpp"

namespace substep::cli {

std::string scenes_folder() {
  const char* folder = std::getenv("SUBSTEP_SCENES");
  return folder && *folder ? folder : SUBSTEP_SCENES_FOLDER;
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder(), error)) {
    const std::filesystem::path& path = entry.path();
    // scene.schema.json is in the same folder.
    if (path.extension() != ".json" || path.stem().has_extension()) continue;
    names.push_back(path.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string scene_path(const std::string& name_or_path) {
  const std::vector<std::string> names = shipped_names();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end()) return name_or_path;
  return (std::filesystem::path(scenes_folder()) / (name_or_path + ".json")).string();
}

namespace {

/// `substep import` has the options, and lists what is left out.
std::shared_ptr<const Scene> import_scene(const std::string& text, const std::string& name,
                                          const ModelFiles& files) {
  const ImportResult result = import_model(text, name, files, {});
  for (const ImportNote& error : result.report.errors.notes)
    complain("%s", to_string(error).c_str());
  const ImportNotes& left_out = result.report.left_out;
  if (result.scene != nullptr && !left_out.empty()) {
    say(stderr, "%s is a model; %zu parts are left out: see `substep import`\n",
        visible_text(name).c_str(), left_out.notes.size() + left_out.more);
  }
  return result.scene;
}

}  // namespace

ModelFiles model_files(const std::filesystem::path& model) {
  return [read = files_beside(model), folder = model.parent_path()](const std::string& name) {
    std::optional<std::string> text = read(name);
    if (text) protect_input((folder / name).string());
    return text;
  };
}

std::shared_ptr<const Scene> load_scene(const std::string& name_or_path) {
  SceneResult result;
  std::string place = name_or_path;
  if (name_or_path == "-") {
    place = "standard input";
    std::string text;  // read_scene() reports a text that is too long
    if (read_bounded(std::cin, kMaxTextSize, text) == Reading::kFailed) {
      complain("%s: %s", place.c_str(), std::strerror(errno));
      return nullptr;
    }
    if (is_model(text)) return import_scene(text, place, {});
    result = read_scene(text);
  } else {
    place = scene_path(name_or_path);
    std::error_code error;
    if (!std::filesystem::exists(place, error)) {
      const std::vector<std::string> names = shipped_names();
      const std::vector<std::string_view> candidates(names.begin(), names.end());
      complain("%s: no such scene or file%s; `substep scenes` lists the scenes",
               name_or_path.c_str(), did_you_mean(name_or_path, candidates).c_str());
      return nullptr;
    }
    std::ifstream file(place, std::ios::binary);
    std::string text;  // read once: it may be a pipe; read_scene() reports a text that is too long
    if (!file || read_bounded(file, kMaxTextSize, text) == Reading::kFailed) {
      result = read_scene_file(place);  // reports why
    } else if (is_model(text)) {
      protect_input(place);
      return import_scene(text, std::filesystem::path(place).filename().string(),
                          model_files(place));
    } else {
      protect_input(place, true);
      result = read_scene(text);
    }
  }
  for (const Problem& problem : result.problems) {
    complain("%s: %s", place.c_str(), to_string(problem).c_str());
  }
  return result.scene;
}

}  // namespace substep::cli
