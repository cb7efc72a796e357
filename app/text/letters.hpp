#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace substep {

/// Bytes as base64url (RFC 4648) without padding: letters that an address holds as they are.
std::string to_letters(const std::vector<std::uint8_t>& bytes);

/// Nothing where the text is none.
std::optional<std::vector<std::uint8_t>> from_letters(std::string_view letters);

}  // namespace substep
