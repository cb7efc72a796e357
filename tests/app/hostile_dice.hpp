#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>

namespace substep {

/// Random numbers that are the same for the same seed on every platform; the distributions of the
/// standard library are not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// 0 to n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  auto pick(const List& list) -> decltype(*std::begin(list)) {
    return *std::next(std::begin(list), static_cast<std::ptrdiff_t>(below(std::size(list))));
  }

 private:
  std::mt19937_64 engine_;
};

/// Makes a few changes to a valid text: bytes, lines, numbers and words.
std::string mutated(std::string text, Dice& dice);

/// N spheres of one size with gravity and contact, all at one point or in a row, as a scene file.
std::string crowd(std::size_t n, bool at_one_point);

}  // namespace substep
