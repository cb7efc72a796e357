#include "core/model/problem.hpp"

#include <algorithm>

namespace substep {

std::string pointer_to(std::string_view parent, std::string_view key) {
  std::string pointer(parent);
  pointer += '/';
  for (const char c : key) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
  return pointer;
}

std::string pointer_to(std::string_view parent, std::size_t index) {
  return std::string(parent) + "/" + std::to_string(index);
}

std::string must_be(std::string_view allowed, std::string_view value) {
  if (value.empty()) value = "\"\"";
  return "must be " + std::string(allowed) + ", not " + std::string(value);
}

std::string too_many(std::size_t count, std::size_t most, std::string_view what) {
  return "must have at most " + std::to_string(most) + " " + std::string(what) + ", not " +
         std::to_string(count);
}

std::string to_string(const Problem& problem) {
  return problem.pointer.empty() ? problem.message : problem.pointer + ": " + problem.message;
}

std::string to_code(const Problem& problem) {
  if (problem.pointer.empty()) return problem.message;
  std::string place;
  for (std::size_t at = 1; at <= problem.pointer.size();) {
    const std::size_t end = std::min(problem.pointer.find('/', at), problem.pointer.size());
    const std::string part = problem.pointer.substr(at, end - at);
    if (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos) {
      place += "[" + part + "]";
    } else {
      place += (place.empty() ? "" : ".") + part;
    }
    at = end + 1;
  }
  return place + ": " + problem.message;
}

std::string one_of(std::span<const std::string_view> names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
    list += names[i];
  }
  return list;
}

}  // namespace substep
