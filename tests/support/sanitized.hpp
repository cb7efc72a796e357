#pragma once

// The preset sanitizers defines SUBSTEP_SANITIZED, because it does not instrument the tests' code.
#if defined(SUBSTEP_SANITIZED)
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SUBSTEP_SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SUBSTEP_SANITIZED 1
#endif

namespace substep {

/// How often a test repeats the same code on other numbers. Sanitizers, which make a run 15 times
/// as long, find what the first repetitions do wrong; the optimised build, which runs the same
/// test, finds what only many of them show.
constexpr int repetitions([[maybe_unused]] int optimised, [[maybe_unused]] int with_sanitizers) {
#if defined(SUBSTEP_SANITIZED)
  return with_sanitizers;
#else
  return optimised;
#endif
}

}  // namespace substep
