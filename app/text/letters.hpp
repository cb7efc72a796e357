#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace substep {

/// Bytes as base64url (RFC 4648) without padding: characters that URLs do not escape.
std::string to_letters(const std::vector<std::uint8_t>& bytes);

/// Decodes it; empty if the text is invalid.
std::optional<std::vector<std::uint8_t>> from_letters(std::string_view letters);

}  // namespace substep
