#pragma once
// Where in a text its problems are.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/problem.hpp"

namespace substep {

/// Both from 1.
struct TextPlace {
  std::size_t line = 1;
  std::size_t column = 1;  // [bytes]
  friend bool operator==(const TextPlace&, const TextPlace&) = default;
};

/// The place of a byte. @param offset at most the size of the text
TextPlace place_at(std::string_view text, std::size_t offset);
/// The byte at a place, or the end of its line or of the text if that is before it.
std::size_t offset_of(std::string_view text, const TextPlace& place);

/// "line 3, column 14: ", as syntax errors begin.
std::string place_text(const TextPlace& place);
/// Removes such a beginning. @return the place, if the message had one
std::optional<TextPlace> take_place(std::string& message);

/// The places of problems that parse_json() or read_scene() found in a text. A syntax error says
/// its place itself. Any other one is where the member or the item begins that its pointer names,
/// or the innermost object or list around it if there is none. The time is linear in the text, also
/// if it is no JSON.
std::vector<TextPlace> places_of(const Problems& problems, std::string_view text);

}  // namespace substep
