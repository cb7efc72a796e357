#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/import/model_files.hpp"
#include "core/io/scene_reader.hpp"

namespace substep {

/// The scene of a text that the user opens.
struct OpenedText {
  SceneResult result;
  std::string note;  // of a model: what of it is approximated or left out; or ""
};

/// Reads a scene file, or makes a scene of a model in MJCF, URDF or the JSON of SLRBS.
/// @param from name of the file  @param files those that a model names; empty: they are not read
OpenedText read_opened(std::string_view text, const std::string& from, const ModelFiles& files);

/// The same from a file, with the files beside it.
OpenedText read_opened_file(const std::filesystem::path& path);

}  // namespace substep
