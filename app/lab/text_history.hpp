#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

namespace substep {

/// One range of a text that was replaced.
struct TextChange {
  std::size_t at = 0;  // [bytes]
  std::string removed;
  std::string inserted;

  /// Its text: replaces `removed` by `inserted`.
  void apply(std::string& text) const { text.replace(at, removed.size(), inserted); }
  [[nodiscard]] TextChange inverse() const { return {at, inserted, removed}; }
  [[nodiscard]] std::size_t bytes() const { return removed.size() + inserted.size(); }
};

/// The range in which two texts differ, between whole characters of UTF-8.
TextChange difference(std::string_view before, std::string_view after);

/// The changes of a text, to undo and redo them. Letters that are typed or deleted one after the
/// other count as one change, up to the end of a word.
class TextHistory {
 public:
  /// @param most of what the changes hold; beyond it the oldest are forgotten [bytes]
  explicit TextHistory(std::size_t most) : most_(most) {}

  /// Discards what was undone.
  void add(TextChange change);
  /// The next change begins a step of its own, as after a pause.
  void end_step() { joins_ = false; }
  /// Applied to the text, the change that it returns undoes a step; null if there is none.
  const TextChange* undo();
  /// The same to redo it.
  const TextChange* redo();
  void clear();

  [[nodiscard]] bool can_undo() const { return done_ > 0; }
  [[nodiscard]] bool can_redo() const { return done_ < changes_.size(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  bool join(const TextChange& change);

  std::deque<TextChange> changes_;
  std::size_t done_ = 0;  // of the changes; the others were undone
  std::size_t most_;
  std::size_t bytes_ = 0;  // of all changes
  bool joins_ = false;
  TextChange last_;  // that was returned
};

}  // namespace substep
