#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace substep::cli {

/// A result file, "-" for standard output; an empty path opens nothing. A file is written under a
/// temporary name and renamed when it is closed successfully; until then, and on any error, the
/// existing file is unchanged. Devices and pipes are written directly.
class Output {
 public:
  Output() = default;
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// @return false, with a message on stderr, if the file cannot be written
  bool open(const std::string& path);
  void write(const std::string& text);
  /// Completes the file. @return false, with a message on stderr, if anything could not be written
  bool close();
  /// If end_outputs() ends the file, keep the content so far, followed by `ending`.
  void keep_if_ended(const std::string& ending = "");
  [[nodiscard]] bool is_open() const { return file_ != nullptr; }
  /// Whether a write failed; close() reports it.
  [[nodiscard]] bool failed() const { return error_ != 0; }

 private:
  friend void end_outputs(bool keep);
  bool open_beside();
  bool fail(int error);
  void finish();
  void discard();

  std::string path_;       // as given
  std::string target_;     // with links resolved
  std::string temporary_;  // empty: written directly
  std::FILE* file_ = nullptr;
  int error_ = 0;  // errno of the first failed write
  std::optional<std::string> ending_;
};

/// Ends all open files from another thread, before the program exits. Keeps those with
/// keep_if_ended() if `keep`, and removes the others. Waits 20 ms at most, and does not allocate.
void end_outputs(bool keep);

/// Writes a whole file by means of Output.
bool write_file(const std::string& path, const std::string& text);

/// Opens standard streams that the caller has closed, so that no other file gets their descriptors;
/// and turns SIGPIPE and SIGXFSZ into write errors.
void prepare_streams();

/// Flushes standard output. @return false, with one message on stderr, if anything could not be
/// written
bool flush_standard_output();

/// Whether the path is "-" or another name of standard output, such as /dev/stdout.
bool is_standard_output(const std::string& path);

/// Flags with the files that they name.
using NamedPaths = std::vector<std::pair<const char*, std::string>>;

/// Throws a CLI::ValidationError if two outputs have the same destination, or an output is an
/// input. "-" among the inputs is standard input, which may be a file.
void keep_apart(const NamedPaths& outputs, const std::vector<std::string>& inputs);

/// Whether standard error is a terminal.
bool stderr_is_terminal();

}  // namespace substep::cli
