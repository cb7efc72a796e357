#pragma once

#include <cstdio>
#include <string>

namespace substep::cli {

/// A result file, "-" for standard output. Nothing is opened where the path is empty.
class Output {
 public:
  Output() = default;
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// @return false and a message on stderr where the file cannot be written
  bool open(const std::string& path);
  void write(const std::string& text);
  /// Ends the file. @return false and a message on stderr where not all could be written
  bool close();
  [[nodiscard]] bool is_open() const { return file_ != nullptr; }

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

/// Whether two paths name the same file, or both standard output. Not where one is empty, nor for a
/// device such as /dev/null, which many may write to.
bool same_output(const std::string& a, const std::string& b);

/// Whether a person looks at standard error.
bool stderr_is_terminal();

}  // namespace substep::cli
