#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace substep {

/// A chooser for scene files if the system has none: lists the folders and scene files and models
/// (*.json, *.xml, *.urdf) of one folder at a time.
class FileBrowser {
 public:
  struct Entry {
    std::string name;
    bool folder = false;
  };

  [[nodiscard]] bool open() const { return open_; }
  /// Shows a folder; if it cannot be read, sets problem() and keeps the current one.
  void show(const std::filesystem::path& folder);
  void close() { open_ = false; }
  /// Handles typed text: shows a folder. @return the file that it names, or an empty path
  [[nodiscard]] std::filesystem::path follow(const std::string& text);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Folders first, each sorted by name; without hidden ones.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// Content of the path field: the folder, or typed text.
  [[nodiscard]] std::array<char, 1024>& typed() { return typed_; }
  /// The reason why the last folder could not be shown, or "".
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  bool open_ = false;
  std::filesystem::path folder_;
  std::array<char, 1024> typed_{};
  std::vector<Entry> entries_;
  std::string problem_;
};

}  // namespace substep
