#pragma once

#include <optional>
#include <string>

#include "core/import/mechanism.hpp"
#include "core/import/xml.hpp"

namespace substep {

/// Reads a URDF model, the format of ROS. The link that is no child is fixed to the world, unless
/// `options` frees it or it is called "world". @param root its <robot>  @param file its name, for
/// messages  @return nothing if `report` has errors
std::optional<Mechanism> read_urdf(const XmlElement& root, const std::string& file,
                                   const ImportOptions& options, ImportReport& report);

}  // namespace substep
