#include "core/import/model_files.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/io/json_text.hpp"

namespace substep {

std::optional<std::string> read_model_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) return std::nullopt;
  const auto most = static_cast<std::size_t>(std::min<std::uintmax_t>(size, kMaxTextSize + 1));
  std::string text(most, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

ModelFiles files_beside(const std::filesystem::path& model) {
  return [folder = model.parent_path()](const std::string& name) {
    return read_model_file(folder / name);
  };
}

}  // namespace substep
