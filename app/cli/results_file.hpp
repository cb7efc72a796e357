#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "app/cli/results_text.hpp"
#include "core/io/json.hpp"

namespace substep::cli {

/// Throws a CLI::ValidationError if files of a sweep's folder are the same file, by links.
/// @param results name of the file of results
void keep_files_apart(const std::filesystem::path& folder, const std::string& results);

/// Maximum size of a results file [bytes]: some 250,000 results.
inline constexpr std::size_t kMostResults = 512U << 20U;

/// A results file that stays valid if the program is killed: every line is appended in one write,
/// and a truncated last line is removed when the file is reopened; nothing else is ever removed.
/// Only one program can have it open.
class ResultsFile {
 public:
  ResultsFile() = default;
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Opens or creates the file and reads its results, all of this scene. @return false, with a
  /// message on stderr, if it is not a results file, damaged, of another scene, in use or not
  /// writable; it is then unchanged
  bool open(const std::string& path, const ResultsScene& scene);
  /// Whether there is a result for the experiment of that id.
  [[nodiscard]] bool contains(const std::string& id) const { return results_.contains(id); }
  /// Appends a result; thread-safe. @return false, with a message, if it could not be written; the
  /// file then ends with the previous result
  bool append(const std::string& id, const Json& result);
  /// Rewrites the file in the order of these ids, followed by the others in their order of arrival.
  /// The old file is replaced only by a complete new one.
  bool finish(const std::vector<std::string>& order);

  [[nodiscard]] std::size_t size() const { return results_.order().size(); }
  /// In file order.
  [[nodiscard]] std::vector<Json> results() const;

 private:
  bool take_lock();
  bool load(std::string& text);
  bool read();
  bool write(const std::string& text);

  std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
  StoredResults results_;
};

}  // namespace substep::cli
