#pragma once

#include <chrono>
#include <optional>

#include "core/sim/simulator.hpp"

namespace substep {

/// The budget of a simulation in a window. The window stays responsive between sub-steps; a
/// sub-step of this much work takes about 0.1 s.
inline constexpr Budget kWindowBudget{
    .memory = 64.0 * kMebibyte, .substep = 1e8, .contacts = 10'000.0};

/// Computing time per drawn frame [s].
inline constexpr double kSlice = 0.025;

/// Takes frames in slices of time so that the window stays responsive: a long frame is spread over
/// several calls. The motion equals that of Simulator::step() bit for bit.
class FrameSlices {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLong = 0.01;  // shorter frames are not sliced [s]

  /// Continues the frame or begins one; past `until` it stops between two sub-steps.
  /// @return the report of the whole frame once it has ended, even if it failed
  std::optional<FrameReport> advance(Simulator& simulator, Clock::time_point until);
  /// Whether a frame is in progress.
  [[nodiscard]] bool open() const { return left_ > 0; }
  [[nodiscard]] int taken() const { return taken_; }  ///< sub-steps of the open frame
  [[nodiscard]] int left() const { return left_; }    ///< remaining, as decided so far
  /// The state at the start of the open frame, or the current one.
  [[nodiscard]] const State& state(const Simulator& simulator) const {
    return open() ? start_ : simulator.state();
  }
  /// Discards the open frame and restores its initial state.
  void drop(Simulator& simulator);
  /// Whether the next frame is expected to be short, from the last one.
  [[nodiscard]] bool quick() const { return frame_time_ > 0.0 && frame_time_ < kLong; }
  /// Call after a change that affects the duration of frames.
  void forget() { *this = {}; }

 private:
  State start_;
  int taken_ = 0;
  int left_ = 0;
  double frame_time_ = 0.0;  // of the last frame, 0 if unknown [s]
};

/// The end of a slice that begins now. @param seconds its length
FrameSlices::Clock::time_point end_of_slice(double seconds);

}  // namespace substep
