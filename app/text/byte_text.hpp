#pragma once
// Packing of numbers into bytes, for the events in links.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace substep {

/// Length code of a double that is equal to that of the previous list.
inline constexpr unsigned kRepeated = 9;

/// Emscripten 3.1's library has no std::bit_cast.
inline std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline double double_of(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

class ByteWriter {
 public:
  std::vector<std::uint8_t> bytes;

  void whole(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) {
      bytes.push_back(static_cast<std::uint8_t>(value | 0x80U));
    }
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
  /// Zigzag encoding: small values of either sign take few bytes.
  void difference(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    whole((bits << 1U) ^ (value < 0 ? ~std::uint64_t{0} : 0U));
  }
  /// Each value as its leading bytes up to the last that is not zero; all lengths come first.
  /// @param last equal values are encoded as repeated; may be null
  template <std::size_t n>
  void doubles(const std::array<double, n>& values, const std::array<double, n>* last) {
    std::vector<std::uint8_t> leading;
    unsigned codes = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t bits = bits_of(values[i]);
      unsigned code = 8;
      while (code > 0 && (bits >> (64U - 8U * code) & 0xffU) == 0) --code;
      if (last != nullptr && bits == bits_of((*last)[i])) code = kRepeated;
      for (unsigned byte = 0; code != kRepeated && byte < code; ++byte) {
        leading.push_back(static_cast<std::uint8_t>(bits >> (56U - 8U * byte)));
      }
      codes = (codes << 4U) | code;
      if (i % 2 == 1 || i + 1 == n) {
        bytes.push_back(static_cast<std::uint8_t>(codes));
        codes = 0;
      }
    }
    bytes.insert(bytes.end(), leading.begin(), leading.end());
  }
};

/// Truncated or malformed input ends the reading: ok() is then false.
class ByteReader {
 public:
  explicit ByteReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool done() const { return !ok_ || at_ == bytes_.size(); }

  std::uint8_t byte() {
    if (done()) ok_ = false;
    return ok_ ? bytes_[at_++] : 0;
  }
  std::uint64_t whole() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 63; shift += 7) {
      const std::uint8_t next = byte();
      value |= static_cast<std::uint64_t>(next & 0x7fU) << shift;
      if ((next & 0x80U) == 0) return value;
    }
    ok_ = false;
    return 0;
  }
  std::int64_t difference() {
    const std::uint64_t bits = whole();
    return static_cast<std::int64_t>(bits >> 1U) ^ -static_cast<std::int64_t>(bits & 1U);
  }
  template <std::size_t n>
  std::array<double, n> doubles(const std::array<double, n>* last) {
    std::array<unsigned, n> codes{};
    for (std::size_t i = 0; i < n; i += 2) {
      const unsigned pair = byte();
      codes[i] = i + 1 < n ? pair >> 4U : pair;
      if (i + 1 < n) codes[i + 1] = pair & 15U;
    }
    std::array<double, n> values{};
    for (std::size_t i = 0; i < n; ++i) {
      if (codes[i] > kRepeated || (codes[i] == kRepeated && last == nullptr)) ok_ = false;
      std::uint64_t bits = 0;
      for (unsigned b = 0; ok_ && codes[i] != kRepeated && b < codes[i]; ++b) {
        bits |= static_cast<std::uint64_t>(byte()) << (56U - 8U * b);
      }
      values[i] = codes[i] == kRepeated && last != nullptr ? (*last)[i] : double_of(bits);
    }
    return values;
  }
  std::string text(std::size_t size) {
    std::string text;
    for (std::size_t i = 0; i < size && ok_; ++i) text += static_cast<char>(byte());
    return text;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace substep
