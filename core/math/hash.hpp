#pragma once
// FNV-1a over the bits of doubles: the state hash, equal natively and in the browser.

#include <cstdint>
#include <cstring>

namespace substep {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      value_ ^= (word >> (8 * i)) & 0xffU;
      value_ *= 0x100000001b3ULL;
    }
  }
  void add(double x) {
    std::uint64_t bits = 0;  // Emscripten 3.1's library has no std::bit_cast
    std::memcpy(&bits, &x, sizeof bits);
    add(bits);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace substep
