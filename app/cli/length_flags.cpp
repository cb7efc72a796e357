#include "app/cli/length_flags.hpp"

#include <cmath>

#include "app/cli/within.hpp"

namespace substep::cli {

void LengthFlags::add_to(CLI::App& command) {
  constexpr double kMostSeconds = 86400.0;
  constexpr std::int64_t kMostFrames = 100'000'000;
  auto* by_time = command.add_option("--seconds", seconds, "how long to run [s]")
                      ->check(within(0.0, kMostSeconds));
  auto* by_count = command.add_option("--frames", frames, "how many frames to run")
                       ->check(whole(0, kMostFrames));
  by_time->excludes(by_count);
}

std::int64_t LengthFlags::count(const Scene& scene) const {
  if (frames) return *frames;
  return std::llround(seconds.value_or(scene.criteria.duration) / scene.frame);
}

}  // namespace substep::cli
