#pragma once

#include <string>
#include <string_view>

namespace substep::cli {

/// The text with every byte escaped that could steer a terminal, as in "\x1b": control characters
/// (C0, DEL and C1) and bytes that are no UTF-8. All else stays as it is. It is for messages that
/// show names, keys and paths from outside.
std::string visible_text(std::string_view text);

}  // namespace substep::cli
