#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/io/json.hpp"

namespace substep::cli {

/// The most that a file of results may have [bytes]: some 250,000 results.
inline constexpr std::size_t kMostResults = 512U << 20U;

/// A file of results that a killed program leaves whole: every line is appended in one write, a
/// line that was cut short is taken off when the file is opened again, and nothing else ever is.
/// While one program has it open no other can.
class ResultsFile {
 public:
  ResultsFile() = default;
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Opens or begins the file and reads what is there. @return false and a message on stderr where
  /// it is no results file, broken, in use or not writable; it is then left untouched
  bool open(const std::string& path);
  /// Whether the experiment of that id is done.
  [[nodiscard]] bool contains(const std::string& id) const { return lines_.contains(id); }
  /// Adds a result; from any thread. @return false and a message where it could not be written; the
  /// file then ends with the result before it
  bool append(const std::string& id, const Json& result);
  /// Rewrites the file in the order of these ids, then the others in the order they came. Only a
  /// whole new file takes the place of the old one.
  bool finish(const std::vector<std::string>& order);

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// In the order of the file.
  [[nodiscard]] std::vector<Json> results() const;

 private:
  bool take_lock();
  bool read();
  bool write(const std::string& text);

  std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::map<std::string, std::string> lines_;  // by id, without line feed
  std::vector<std::string> order_;            // ids
};

/// Reads the lines of a results file into id -> line. @return false and messages on stderr, with
/// file and line, where one is wrong
bool read_results(const std::string& path, const std::string& text,
                  std::map<std::string, std::string>& lines, std::vector<std::string>& order);

/// What two results of one experiment must agree in: all but the times.
std::string without_timing(const std::string& line);

}  // namespace substep::cli
