#pragma once

#include <optional>
#include <string>

#include "core/import/mechanism.hpp"
#include "core/import/model_files.hpp"
#include "core/import/xml.hpp"

namespace substep {

/// Reads an MJCF model, the format of MuJoCo. @param root its <mujoco>  @param file its name, for
/// messages  @return nothing if `report` has errors
std::optional<Mechanism> read_mjcf(XmlElement root, const std::string& file,
                                   const ModelFiles& files, const ImportOptions& options,
                                   ImportReport& report);

}  // namespace substep
