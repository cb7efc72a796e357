#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace substep {

/// Chooses a scene file where the system has no chooser of its own to offer: the folders and the
/// scene files (*.json) of one folder at a time.
class FileBrowser {
 public:
  struct Entry {
    std::string name;
    bool folder = false;
  };

  [[nodiscard]] bool open() const { return open_; }
  /// Shows a folder; where it cannot be read says so and stays where it was.
  void show(const std::filesystem::path& folder);
  void close() { open_ = false; }
  /// What a person typed: a folder is shown. @return the file that it names, or an empty path
  [[nodiscard]] std::filesystem::path follow(const std::string& text);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Folders first, each by name; what is hidden is left out.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// What stands in the field for the path: the folder, or what a person types over it.
  [[nodiscard]] std::array<char, 1024>& typed() { return typed_; }
  /// Why the last folder could not be shown, or "".
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  bool open_ = false;
  std::filesystem::path folder_;
  std::array<char, 1024> typed_{};
  std::vector<Entry> entries_;
  std::string problem_;
};

}  // namespace substep
