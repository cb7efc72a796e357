#pragma once

#include <chrono>
#include <optional>

#include "core/sim/simulator.hpp"

namespace substep {

/// The budget of a simulation in a window. The window answers between two sub-steps; one of so much
/// work takes about 0.1 s.
inline constexpr Budget kWindowBudget{
    .memory = 64.0 * kMebibyte, .substep = 1e8, .contacts = 10'000.0};

/// Computing between two pictures [s].
inline constexpr double kSlice = 0.025;

/// Takes frames in slices of time, so that the window keeps answering: a frame that is long is
/// taken over several calls. The motion is that of Simulator::step(), bit for
/// bit.
class FrameSlices {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLong = 0.01;  // what is shorter is taken at once [s]

  /// Goes on with the frame, or begins one: after `until` it stops at a sub-step.
  /// @return the report of the whole frame where it has ended, failed ones included
  std::optional<FrameReport> advance(Simulator& simulator, Clock::time_point until);
  /// Whether a frame has begun and not ended.
  [[nodiscard]] bool open() const { return left_ > 0; }
  [[nodiscard]] int taken() const { return taken_; }  ///< sub-steps of the open frame
  [[nodiscard]] int left() const { return left_; }    ///< to come, as decided so far
  /// The state at the start of the open frame, else the present one.
  [[nodiscard]] const State& state(const Simulator& simulator) const {
    return open() ? start_ : simulator.state();
  }
  /// Leaves the open frame: the simulation is where it began.
  void drop(Simulator& simulator);
  /// Whether the next frame is expected to be as short as the last one.
  [[nodiscard]] bool quick() const { return frame_time_ > 0.0 && frame_time_ < kLong; }
  /// After what changes how long frames take.
  void forget() { *this = {}; }

 private:
  State start_;
  int taken_ = 0;
  int left_ = 0;
  double frame_time_ = 0.0;  // of the last frame, 0 where nothing is known [s]
};

/// Until when a slice that begins now goes. @param seconds of it
FrameSlices::Clock::time_point end_of_slice(double seconds);

}  // namespace substep
