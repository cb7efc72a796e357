#include "app/text/letters.hpp"

namespace substep {
namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

}  // namespace

std::string to_letters(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  unsigned bits = 0;
  int count = 0;
  for (const std::uint8_t byte : bytes) {
    bits = (bits << 8U) | byte;
    count += 8;
    while (count >= 6) {
      count -= 6;
      text += kLetters[(bits >> static_cast<unsigned>(count)) & 63U];
    }
  }
  if (count > 0) text += kLetters[(bits << static_cast<unsigned>(6 - count)) & 63U];
  return text;
}

// The encoding is unique: unused bits of the last character are zero.
std::optional<std::vector<std::uint8_t>> from_letters(std::string_view letters) {
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char letter : letters) {
    const std::size_t value = kLetters.find(letter);
    if (value == std::string_view::npos) return std::nullopt;
    bits = ((bits << 6U) | static_cast<unsigned>(value)) & 0x3fffU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
  }
  const unsigned left = bits & ((1U << static_cast<unsigned>(count)) - 1U);
  if (count == 6 || left != 0) return std::nullopt;
  return bytes;
}

}  // namespace substep
