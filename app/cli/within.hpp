#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/number_text.hpp"
#include "core/model/problem.hpp"

namespace substep::cli {

/// Accepts a number from `least` to `most`. CLI::Range accepts "nan", which is unordered.
inline CLI::Validator within(double least, double most) {
  const std::string range = number_text(least) + " to " + number_text(most);
  return {[=](std::string& text) {
            const auto number = parse_number(text);
            if (number && *number >= least && *number <= most) return std::string();
            return must_be("from " + range, text);
          },
          "in [" + range + "]"};
}

/// Accepts a whole number from `least` to `most`.
inline CLI::Validator whole(std::int64_t least, std::int64_t most) {
  const std::string range = std::to_string(least) + " to " + std::to_string(most);
  return {[=](std::string& text) {
            const auto number = parse_integer(text);
            if (number && *number >= least && *number <= most) return std::string();
            return must_be("a whole number from " + range, text);
          },
          "in [" + range + "]"};
}

/// Accepts one of the names.
inline CLI::Validator among(const std::vector<std::string_view>& names) {
  const std::string allowed = one_of(names);
  return {[=](std::string& text) {
            const bool known = std::find(names.begin(), names.end(), text) != names.end();
            return known ? std::string() : must_be(allowed, text);
          },
          allowed};
}

/// Accepts a file or folder name; rejects an empty one, probably an unset variable.
inline CLI::Validator named() {
  return {[](std::string& text) { return text.empty() ? "the name is empty" : std::string(); }, ""};
}

}  // namespace substep::cli
