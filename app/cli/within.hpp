#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/model/number_text.hpp"

namespace substep::cli {

/// Accepts a number from `least` to `most`. CLI::Range accepts "nan", which is unordered.
inline CLI::Validator within(double least, double most) {
  const std::string range = number_text(least) + " to " + number_text(most);
  return {[=](std::string& text) {
            const auto number = parse_number(text);
            if (number && *number >= least && *number <= most) return std::string();
            return "Value " + text + " not in range " + range;
          },
          "in [" + range + "]"};
}

/// Accepts a file or folder name; rejects an empty one, probably an unset variable.
inline CLI::Validator named() {
  return {[](std::string& text) { return text.empty() ? "the name is empty" : std::string(); }, ""};
}

}  // namespace substep::cli
