#pragma once

#include <string>
#include <string_view>

namespace substep::cli {

/// Escapes every byte that could control a terminal, as in "\x1b": control characters (C0, DEL and
/// C1) and invalid UTF-8. The rest is unchanged. For messages that contain external names, keys and
/// paths.
std::string visible_text(std::string_view text);

}  // namespace substep::cli
