#pragma once

#include <optional>

#include "core/import/mechanism.hpp"
#include "core/io/json.hpp"

namespace substep {

/// Whether a document has the outline of an SLRBS scene: bodies with ids and joints between ids.
bool is_slrbs(const Json& json);

/// Reads a scene of SLRBS, the simulator of the paper's authors: boxes, spheres and cylinders, with
/// hinges about the x axis of their frames and spherical joints. Y is up.
/// @return nothing if `report` has errors
std::optional<Scene> read_slrbs(const Json& json, const ImportOptions& options,
                                ImportReport& report, ScenePlaces& places);

}  // namespace substep
