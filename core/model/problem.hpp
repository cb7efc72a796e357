#pragma once
// Problems in input data, by location.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace substep {

/// One problem in data from a file or from a program.
struct Problem {
  std::string pointer;  // JSON pointer to the place, "" for the whole document
  std::string message;  // value and allowed range: "must be at least 1e-30 (kg), not -1"
};
using Problems = std::vector<Problem>;

/// Limit per document. Readers stop there, so that hostile input cannot exhaust memory.
inline constexpr std::size_t kMaxProblems = 1000;

/// "/bodies/3/mass: must be at least 1e-30 (kg), not -1"
std::string to_string(const Problem& problem);

/// The same with the location in C++ syntax: "bodies[3].mass: must be at least 1e-30 (kg), not -1"
std::string to_code(const Problem& problem);

/// The message for an invalid value: "must be true or false, not 3".
std::string must_be(std::string_view allowed, std::string_view value);

/// The message for too many of something: "must have at most 5 bytes, not 6".
std::string too_many(std::size_t count, std::size_t most, std::string_view what);

/// "ball, box or plane"
std::string one_of(std::span<const std::string_view> names);

/// The pointer of a member: "/bodies" and "a/b" give "/bodies/a~1b" (RFC 6901).
std::string pointer_to(std::string_view parent, std::string_view key);
std::string pointer_to(std::string_view parent, std::size_t index);

}  // namespace substep
