#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace substep::cli {

/// A line on the terminal that is rewritten in place, at most ten times per second.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown) : shown_(shown) {}
  /// Whether the next text would be shown.
  [[nodiscard]] bool due() const {
    return shown_ && std::chrono::steady_clock::now() - last_ >= std::chrono::milliseconds(100);
  }
  void show(const std::string& text) {
    if (!shown_) return;
    last_ = std::chrono::steady_clock::now();
    written_ = true;
    std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
  }
  void clear() const {
    if (written_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool shown_;
  bool written_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace substep::cli
