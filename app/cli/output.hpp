#pragma once

#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace substep::cli {

/// Declares a file that the program has read, so that no output replaces it. Pipes and devices have
/// nothing to protect. @param in_place an output that is opened in place may replace it
void protect_input(const std::string& path, bool in_place = false);

/// @return false, with a message on stderr, if an output of this path would replace an input
bool spares_inputs(const std::string& path, bool in_place = false);

/// A result file, "-" for standard output; an empty path opens nothing. A file is written under a
/// temporary name and renamed when it is closed successfully; until then, and on any error, the
/// existing file is unchanged. Devices and pipes are written directly. The temporary name has the
/// process id and is never the name of something that exists.
class Output {
 public:
  Output() = default;
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// @param in_place it may replace the input that it changes, see protect_input()
  /// @return false, with a message on stderr, if the file cannot be written
  bool open(const std::string& path, bool in_place = false);
  void write(const std::string& text);
  /// Writes the end of the content: if end_outputs() ends the file now, it is complete.
  void write_last(const std::string& text);
  /// Completes the file. @return false, with a message on stderr, if anything could not be written
  bool close();
  /// If end_outputs() ends the file, keep the content so far, followed by `ending`.
  void keep_if_ended(std::string ending = "");
  [[nodiscard]] bool is_open() const { return file_ != nullptr; }
  /// Whether a write failed; close() reports it.
  [[nodiscard]] bool failed() const { return error_ != 0; }

 private:
  friend void end_outputs(bool keep);
  bool open_beside();
  bool fail(int error) const;
  void put(const std::string& text);
  void finish();
  void discard();
  void end(bool keep);
  void forget_temporary();
  [[nodiscard]] std::unique_lock<std::mutex> commit_if_beside() const;

  std::string path_;        // as given
  std::string target_;      // with links resolved
  bool is_beside_ = false;  // written to a new file beside the target
  std::string temporary_;   // its name; empty once it is renamed
  Output* next_ = nullptr;  // in the list of open outputs
  std::timed_mutex mutex_;  // of the members below
  std::FILE* file_ = nullptr;
  int error_ = 0;  // errno of the first failed write
  std::optional<std::string> ending_;
};

/// Held while a file is replaced or appended to: end_outputs() waits for its end. The holder must
/// not allocate, as end_outputs() is also called when there is no memory.
std::unique_lock<std::mutex> commit();

/// Ends all open files from another thread, before the program exits. Waits for a commit() in
/// progress, and no other begins afterwards. Keeps the files with keep_if_ended() if `keep`, and
/// removes the others. A write that is blocked by a pipe is left after 20 ms. Does not allocate.
void end_outputs(bool keep);

/// Removes the temporary files of all open outputs, before the program exits at once. Only for
/// signal handlers: it does not lock or allocate.
void remove_temporaries();

/// Writes a whole file by means of Output.
bool write_file(const std::string& path, const std::string& text, bool in_place = false);

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
