#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace substep {

/// Numbers separated by blanks, at most `most` of them; nothing if anything else is in the text.
std::optional<std::vector<double>> numbers_of(std::string_view text, std::size_t most);

}  // namespace substep
