#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/model/number_text.hpp"

namespace substep::cli {

/// A number from `least` to `most`. CLI::Range lets "nan" through, which compares with nothing.
inline CLI::Validator within(double least, double most) {
  const std::string range = number_text(least) + " to " + number_text(most);
  return {[=](std::string& text) {
            const auto number = parse_number(text);
            if (number && *number >= least && *number <= most) return std::string();
            return "Value " + text + " not in range " + range;
          },
          "in [" + range + "]"};
}

}  // namespace substep::cli
