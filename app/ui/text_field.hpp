#pragma once
// A field for a text of many lines, with line numbers and marked lines.

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/ui/look.hpp"

namespace substep::ui {

/// A line with a mark, and the words of the mark.
struct LineMark {
  std::size_t line = 1;
  std::string text;
};

/// The state of such a field. Its owner keeps the text itself; Dear ImGui keeps a copy while the
/// field has the keyboard.
class TextField {
 public:
  /// @param most length of the text [bytes]
  explicit TextField(std::size_t most) : most_(most) {}

  /// Shows another text; where it differs, the cursor goes.
  void show(const std::string& text);
  /// Takes the keyboard, and moves the cursor to a byte of the text.
  void go_to(std::size_t offset);
  /// Takes the keyboard.
  void take_keyboard() { wants_keyboard_ = true; }

  /// Draws the field. @param marks by line @return whether the user changed the text
  bool draw(const Look& look, const char* label, ImVec2 size, std::span<const LineMark> marks);
  /// After draw(): the text with the user's changes.
  [[nodiscard]] const char* text() const { return buffer_.empty() ? "" : buffer_.data(); }
  /// After draw(): whether the field has the keyboard.
  [[nodiscard]] bool active() const { return active_; }

 private:
  static int edited(ImGuiInputTextCallbackData* data);
  void complete(ImGuiInputTextCallbackData& data);
  void indent(ImGuiInputTextCallbackData& data);
  void draw_lines(const Look& look, ImVec2 from, ImVec2 to, float gutter, float first_line,
                  std::span<const LineMark> marks) const;

  std::size_t most_;
  std::vector<char> buffer_;         // that Dear ImGui reads and writes, with a zero at the end
  std::optional<std::string> next_;  // text to show while it has the keyboard
  std::optional<std::size_t> cursor_;
  std::size_t length_ = 0;  // in the last frame [bytes]
  bool wants_keyboard_ = false;
  bool active_ = false;
};

}  // namespace substep::ui
