#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/experiment.hpp"

namespace substep::cli {

/// The scene that results belong to.
struct ResultsScene {
  std::string name;
  std::uint64_t hash = 0;  // scene_hash()
  std::string from;        // for messages: where this is known from
};

/// The results of one or more files, all of the same scene.
class StoredResults {
 public:
  /// Accepts results of this scene only; otherwise the first result determines the scene.
  void bind(ResultsScene scene) { scene_ = std::move(scene); }
  /// Nothing if there are no results, and none was bound.
  [[nodiscard]] const std::optional<ResultsScene>& scene() const { return scene_; }

  /// Adds the lines of a file. @return false, with messages on stderr giving file and line, if one
  /// is invalid, is of another scene, or contradicts a known one
  bool read(const std::string& path, const std::string& text);
  /// Adds a result of this program. @return false if it is known
  bool add(const std::string& id, std::string line);
  void sort(std::vector<std::string> order) { order_ = std::move(order); }

  [[nodiscard]] bool contains(const std::string& id) const { return lines_.contains(id); }
  /// Without line feed; it must be known.
  [[nodiscard]] const std::string& line(const std::string& id) const { return lines_.at(id); }
  /// The ids in the order of arrival, or as sorted.
  [[nodiscard]] const std::vector<std::string>& order() const { return order_; }
  /// The header and all lines in their order.
  [[nodiscard]] std::string text() const;

  friend bool operator==(const StoredResults& a, const StoredResults& b) {
    return a.lines_ == b.lines_ && a.order_ == b.order_;
  }

 private:
  bool is_of_scene(const std::string& place, const Experiment& experiment);

  std::optional<ResultsScene> scene_;
  std::map<std::string, std::string> lines_;  // by id
  std::vector<std::string> order_;
};

/// Whether the end of a results file, without a line feed, is the beginning of a line, as a killed
/// program or an incomplete copy leaves it.
bool is_cut_line(const std::string& end);

}  // namespace substep::cli
