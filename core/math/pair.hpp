#pragma once
// Two doubles at a time, as in SSE2, NEON and WebAssembly SIMD. Each lane is bitwise equal to the
// scalar computation.

namespace substep {

using Pair [[gnu::vector_size(16)]] = double;

/// Unaligned load of two numbers. Avoid for recent scalar stores: store forwarding would stall.
inline Pair load_pair(const double* from) {
  Pair pair;
  __builtin_memcpy(&pair, from, sizeof pair);
  return pair;
}
inline void store_pair(const Pair& pair, double* to) { __builtin_memcpy(to, &pair, sizeof pair); }

}  // namespace substep
