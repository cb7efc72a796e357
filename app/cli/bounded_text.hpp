#pragma once
// Bounded reading of streams that may be infinite.

#include <cstddef>
#include <istream>
#include <string>

namespace substep::cli {

/// Result of a read.
enum class Reading {
  kWhole,    // the text, or a line with its line feed
  kCut,      // the last line, without a line feed
  kEnd,      // end of the stream
  kTooLong,  // the text is longer than `most` bytes
  kFailed,   // see errno, such as EISDIR for a folder
};

/// Reads a stream to its end, but no more than `most` + 1 bytes: kWhole, kTooLong or kFailed.
Reading read_bounded(std::istream& stream, std::size_t most, std::string& text);

/// Reads the next line, without its line feed: any result.
Reading read_line_bounded(std::istream& stream, std::size_t most, std::string& line);

}  // namespace substep::cli
