#include "app/cli/bounded_text.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace substep::cli {
namespace {

/// Whether reading ended with an error. std::cin reports an error as the end of the file.
bool broken(const std::istream& stream) {
  return stream.bad() || (&stream == &std::cin && std::ferror(stdin) != 0);
}

}  // namespace

Reading read_bounded(std::istream& stream, std::size_t most, std::string& text) {
  constexpr std::size_t kPiece = 1U << 16U;  // [bytes]
  text.clear();
  while (stream && text.size() <= most) {
    const std::size_t before = text.size();
    text.resize(std::min(before + kPiece, most + 1));
    stream.read(&text[before], static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > most) return Reading::kTooLong;
  return stream.eof() && !broken(stream) ? Reading::kWhole : Reading::kFailed;
}

Reading read_line_bounded(std::istream& stream, std::size_t most, std::string& line) {
  constexpr std::size_t kPiece = 1U << 12U;  // [bytes]
  line.clear();
  if (stream.eof()) return Reading::kEnd;
  if (!stream) return Reading::kFailed;
  char piece[kPiece];
  for (;;) {
    stream.getline(piece, sizeof piece);
    const auto got = static_cast<std::size_t>(stream.gcount());
    if (broken(stream)) return Reading::kFailed;
    if (stream.eof()) {
      line.append(piece, got);
      if (line.size() > most) return Reading::kTooLong;
      return line.empty() ? Reading::kEnd : Reading::kCut;
    }
    const bool full = stream.fail();  // the piece has no line feed
    line.append(piece, full ? got : got - 1);
    if (line.size() > most) return Reading::kTooLong;
    if (!full) return Reading::kWhole;
    stream.clear();
  }
}

}  // namespace substep::cli
