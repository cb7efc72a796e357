#pragma once
// Two doubles at a time, which SSE2, NEON and WebAssembly's vectors all have. Each lane computes
// what a scalar would, bit for bit.

namespace substep {

using Pair [[gnu::vector_size(16)]] = double;

/// Two numbers of a row in memory, wherever it begins. Not of what has just been written one by
/// one: that would have to reach memory first.
inline Pair load_pair(const double* from) {
  Pair pair;
  __builtin_memcpy(&pair, from, sizeof pair);
  return pair;
}
inline void store_pair(const Pair& pair, double* to) { __builtin_memcpy(to, &pair, sizeof pair); }

}  // namespace substep
