#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace substep {

/// Reads a file that a model names, such as an include or a mesh, by its path relative to the
/// model. Nothing if there is none.
using ModelFiles = std::function<std::optional<std::string>(const std::string& path)>;

/// A regular file: devices and pipes may have no end. Of a file that is longer than any model may
/// be, one byte more than that is read.
std::optional<std::string> read_model_file(const std::filesystem::path& path);

/// The files beside a model. @param model path of its file
ModelFiles files_beside(const std::filesystem::path& model);

}  // namespace substep
