#include "app/shell/file_browser.hpp"

#include <algorithm>
#include <system_error>

namespace substep {

namespace fs = std::filesystem;

namespace {

/// Scenes and models.
bool is_opened(const fs::path& path) {
  const std::string end = path.extension().string();
  return end == ".json" || end == ".xml" || end == ".urdf";
}

}  // namespace

void FileBrowser::show(const fs::path& folder) {
  open_ = true;
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder, error), error);
  std::vector<Entry> found;
  fs::directory_iterator list(whole, fs::directory_options::skip_permission_denied, error);
  if (error) {
    problem_ = folder.string() + ": " + error.message();
    return;
  }
  for (const fs::directory_iterator end; list != end && !error; list.increment(error)) {
    const std::string name = list->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code unreadable;  // a dangling link is not a folder
    const bool is_folder = list->is_directory(unreadable);
    if (is_folder || is_opened(list->path())) found.push_back({name, is_folder});
  }
  std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
  folder_ = whole;
  const std::string path = folder_.string().substr(0, typed_.size() - 1);
  typed_.fill('\0');
  std::copy(path.begin(), path.end(), typed_.begin());
  entries_ = std::move(found);
  problem_.clear();
}

fs::path FileBrowser::follow(const std::string& text) {
  fs::path path(text);
  if (path.is_relative()) path = folder_ / path;
  std::error_code error;
  if (fs::is_regular_file(path, error)) return path;
  show(path);
  return {};
}

}  // namespace substep
