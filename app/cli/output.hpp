#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace substep::cli {

/// A result file, "-" for standard output. Nothing is opened where the path is empty. A file is
/// written beside its place and takes it when it is closed whole: until then, and where anything
/// fails, what was there before stays as it was. Devices and pipes are written directly.
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
  /// What is written so far is worth keeping, with this behind it, where end_outputs() ends it.
  void keep_if_ended(const std::string& ending = "");
  [[nodiscard]] bool is_open() const { return file_ != nullptr; }
  /// Whether something could not be written; close() will say so.
  [[nodiscard]] bool failed() const { return error_ != 0; }

 private:
  friend void end_outputs(bool keep);
  bool open_beside();
  bool fail(int error);
  void finish();
  void discard();

  std::string path_;       // as it was given
  std::string target_;     // behind all links
  std::string temporary_;  // empty: written directly
  std::FILE* file_ = nullptr;
  int error_ = 0;  // errno of the first write that failed
  std::optional<std::string> ending_;
};

/// Ends all files that are open, from another thread than those that write them: the program is
/// about to end. Keeps those that say so, if it is to keep any, removes the others, waits for no
/// one and needs no memory.
void end_outputs(bool keep);

/// Writes a whole file, as Output does.
bool write_file(const std::string& path, const std::string& text);

/// Gives the standard streams that were closed by the caller a place, so that no file that is
/// opened takes theirs; and lets a pipe or a disk that takes no more be an error instead of a
/// signal.
void prepare_streams();

/// Flushes standard output. @return false and, once, a message on stderr where not all of it could
/// be written
bool flush_standard_output();

/// Whether the path is "-" or another name of standard output, such as /dev/stdout.
bool is_standard_output(const std::string& path);

/// Whether two paths name the same file, or both standard output. Not where one is empty, nor for a
/// device such as /dev/null, which many may write to.
bool same_output(const std::string& a, const std::string& b);

/// Flags, and the files that they name.
using NamedPaths = std::vector<std::pair<const char*, std::string>>;

/// Throws a CLI::ValidationError where two outputs go to one place, or one to that of an input. "-"
/// among the inputs is standard input, which may come from a file.
void keep_apart(const NamedPaths& outputs, const std::vector<std::string>& inputs);

/// Whether a person looks at standard error.
bool stderr_is_terminal();

}  // namespace substep::cli
