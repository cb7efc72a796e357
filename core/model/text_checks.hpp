#pragma once
// Which characters a name, a group or another text of a scene may hold, and how the others are
// shown.

#include <optional>
#include <string>
#include <string_view>

namespace substep {

/// The fault of a text, or nothing: " has a control character (U+0007)" after the text itself. A
/// text is one line of valid UTF-8 whose characters stand in the order in which they are stored.
/// Refused are control characters (C0, DEL, C1), line and paragraph separators, marks, overrides
/// and isolates of the direction of writing, and characters without width, such as a byte order
/// mark. U+200C and U+200D, which join or separate letters, are allowed after others than ASCII:
/// several scripts need them.
std::optional<std::string> text_fault(std::string_view text);

/// A text for people, on one line: the bytes of every character that text_fault() refuses are
/// escaped, as in "\x1b". The rest is unchanged.
std::string visible_text(std::string_view text);

/// Lines of text, each of them visible_text().
std::string visible_lines(std::string_view text);

}  // namespace substep
