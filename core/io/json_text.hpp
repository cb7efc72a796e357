#pragma once
// Parses text to a JSON document, with problems instead of exceptions.

#include <optional>
#include <string>
#include <string_view>

#include "core/io/json.hpp"
#include "core/model/problem.hpp"

namespace substep {

// Limits that protect against memory exhaustion by hostile or broken files.
inline constexpr std::size_t kMaxTextSize = 32U << 20U;   // [bytes]
inline constexpr std::size_t kMaxJsonDepth = 16;          // nested objects and lists
inline constexpr std::size_t kMaxJsonValues = 4'000'000;  // values of any kind

/// Parses a whole text. A syntax error is reported with line and column, without a document. A
/// duplicate key (the last one counts) and a number beyond the range of doubles (replaced by null)
/// are problems with a pointer; the document is still returned.
std::optional<Json> parse_json(std::string_view text, Problems& problems);

/// A value for messages: on one line, truncated if long.
std::string value_text(const Json& value);

}  // namespace substep
