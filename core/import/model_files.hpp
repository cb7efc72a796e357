#pragma once

#include <functional>
#include <optional>
#include <string>

namespace substep {

/// Reads a file that a model names, such as an include or a mesh, by its path relative to the
/// model. Nothing if there is none.
using ModelFiles = std::function<std::optional<std::string>(const std::string& path)>;

}  // namespace substep
