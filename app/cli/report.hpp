#pragma once

#include <filesystem>
#include <vector>

#include "core/io/json.hpp"
#include "core/model/scene.hpp"

namespace substep::cli {

/// Writes report.html into the folder: every picture of these results in one file that opens
/// without a network. @param scene may be null where it is not known. @return false and a message
/// on stderr where it cannot be written
bool write_report(const std::filesystem::path& folder, const Scene* scene,
                  const std::vector<Json>& results, bool quiet);

}  // namespace substep::cli
