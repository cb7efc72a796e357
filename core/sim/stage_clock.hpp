#pragma once

#include <chrono>

namespace substep {

/// Adds the time since the last call to the stage that has just ended.
class StageClock {
 public:
  /// A disabled clock adds nothing and never reads the system clock.
  explicit StageClock(bool runs = true) : runs_(runs) {
    if (runs_) last_ = Clock::now();
  }
  void lap(double& stage) {
    if (!runs_) return;
    const auto now = Clock::now();
    stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool runs_;
  Clock::time_point last_;
};

}  // namespace substep
