#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/import/import_options.hpp"
#include "core/import/import_report.hpp"
#include "core/import/model_files.hpp"
#include "core/model/scene.hpp"

namespace substep {

struct ImportResult {
  std::shared_ptr<const Scene> scene;  // null if the report has errors
  ImportReport report;
};

/// Whether a text looks like a model rather than a scene: it is XML, or JSON with the words of
/// SLRBS. It is not parsed.
bool is_model(std::string_view text);

/// Makes a scene of a model in MJCF, URDF or the JSON of SLRBS. The scene is valid. Never throws.
/// @param name of the model's file, for messages and as a name of the scene
/// @param files reads what the model names: includes and meshes; may be empty
ImportResult import_model(std::string_view text, const std::string& name, const ModelFiles& files,
                          const ImportOptions& options);

}  // namespace substep
