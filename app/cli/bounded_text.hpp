#pragma once
// Reading what may never end, with limits that act while reading.

#include <cstddef>
#include <istream>
#include <string>

namespace substep::cli {

/// How a piece of a stream was read.
enum class Reading {
  kWhole,    // the text, or a line with its line feed
  kCut,      // the last line, which has no line feed
  kEnd,      // nothing was left
  kTooLong,  // the text ends after `most` bytes
  kFailed,   // errno says why, such as EISDIR of a folder
};

/// Reads a stream to its end, but no more than `most` + 1 bytes: kWhole, kTooLong or kFailed.
Reading read_bounded(std::istream& stream, std::size_t most, std::string& text);

/// Reads the next line, without its line feed: any of them.
Reading read_line_bounded(std::istream& stream, std::size_t most, std::string& line);

}  // namespace substep::cli
