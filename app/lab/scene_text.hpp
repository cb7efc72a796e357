#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/text_history.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/text_places.hpp"

namespace substep {

/// A problem of a text with its place. The message of a syntax error is without the place.
struct PlacedProblem {
  TextPlace place;
  Problem problem;
};

/// A scene as text while it is edited: its history, and what the reader of scenes finds in it.
class SceneText {
 public:
  /// Limit of the text. A longer scene is edited in a text editor [bytes].
  static constexpr std::size_t kMost = 512U << 10U;
  static constexpr std::size_t kMostHistory = 8U << 20U;  // [bytes]
  /// A text up to this size is checked in the frame of an edit, a longer one after a pause in
  /// slices [bytes].
  static constexpr std::size_t kQuick = 32U << 10U;
  static constexpr double kPause = 0.4;  // [s]

  /// Shows the text of another scene, without problems; undo() returns to the text before it.
  void show(std::string text, std::shared_ptr<const Scene> scene);
  /// Replaces the text and records the change. @return false if it is too long: then nothing
  /// changes
  bool edit(std::string text);
  /// The next edit is a step of its own.
  void end_step() { history_.end_step(); }
  /// @return the change of the text, or null if there is none to undo
  const TextChange* undo();
  const TextChange* redo();
  /// Checks the text if it is time. @param dt since the last call [s] @param seconds budget
  void advance(double dt, double seconds);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool can_undo() const { return history_.can_undo(); }
  [[nodiscard]] bool can_redo() const { return history_.can_redo(); }
  /// Whether problems() and scene() are those of the current text.
  [[nodiscard]] bool checked() const { return checked_; }
  /// Of the text that was checked last, by line; at most kMaxProblems and a line that says so.
  [[nodiscard]] const std::vector<PlacedProblem>& problems() const { return problems_; }
  /// The scene that the text describes; null if it has problems or is not checked.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  /// Time since the last edit [s].
  [[nodiscard]] double idle() const { return idle_; }
  /// Whether the text differs from the one that was shown, or taken over as the run's.
  [[nodiscard]] bool changed() const { return text_ != loaded_; }
  /// Takes the text over as the run's.
  void mark_loaded() { loaded_ = text_; }
  /// The last text that was the run's.
  [[nodiscard]] const std::string& loaded() const { return loaded_; }
  /// The text with the line breaks of scene files, or nothing if it is not JSON.
  [[nodiscard]] std::optional<std::string> formatted() const;

 private:
  void take(const TextChange& change);
  void text_changed();
  void finish_check();

  std::string text_;
  std::string loaded_;
  TextHistory history_{kMostHistory};
  std::unique_ptr<SceneReading> reading_;  // of the current text
  std::vector<PlacedProblem> problems_;
  std::shared_ptr<const Scene> scene_;
  double idle_ = 0.0;
  bool checked_ = true;
};

}  // namespace substep
