#pragma once
// From text to a JSON document, with problems instead of exceptions.

#include <optional>
#include <string>
#include <string_view>

#include "core/io/json.hpp"
#include "core/model/problem.hpp"

namespace substep {

// Limits that keep a hostile or broken file from using up memory.
inline constexpr std::size_t kMaxTextSize = 32U << 20U;   // [bytes]
inline constexpr std::size_t kMaxJsonDepth = 16;          // nested objects and lists
inline constexpr std::size_t kMaxJsonValues = 4'000'000;  // values of any kind

/// Parses a whole text. A syntax error names line and column, and there is no document. A key that
/// stands twice in an object (the last one counts) and a number beyond the range of doubles (null
/// stands in its place) are problems with a pointer, and there is a document all the same.
std::optional<Json> parse_json(std::string_view text, Problems& problems);

/// A value as messages show it: on one line, cut when it is long.
std::string value_text(const Json& value);

}  // namespace substep
