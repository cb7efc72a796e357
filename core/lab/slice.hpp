#pragma once

#include <chrono>

namespace substep {

/// Of a frame that is taken in parts where something must answer meanwhile [floating-point
/// operations]: some hundredths of a second.
inline constexpr double kPartWork = 2e7;

/// Takes steps for about that long, at least one: for work in slices where there are no
/// threads. @param step one more; returns whether there is another  @return the same of the last
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
