#pragma once

#include <chrono>

namespace substep {

/// Work per part of a frame, to keep the caller responsive [floating-point operations]: some
/// hundredths of a second.
inline constexpr double kPartWork = 2e7;

/// Takes steps for about this long, at least one: for work in slices without threads. @param step
/// takes one step; returns true if there are more @return the result of the last step
template <class Step>
bool advance_for(double seconds, const Step& step) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  bool more = true;
  do {
    more = step();
  } while (more && Clock::now() < end);
  return more;
}

}  // namespace substep
