#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/sim/report.hpp"

namespace substep {

/// What the plots show, one number a frame.
enum class Channel : std::uint8_t {
  kSubsteps,      // N taken [-]
  kLimit,         // N at alpha = 1: fewer than this is unstable [-], 0 where K is not known
  kKinetic,       // [J]
  kEnergyChange,  // total energy minus that at the start [J]
  kJointError,    // sum over joints of the 1-norm of phi [m, rad]
  kPenetration,   // largest overlap of a contact [m]
  kTime,          // wall time of the frame [ms]
  kCount
};

/// The last minutes of a run, one sample a frame, oldest first and contiguous.
class History {
 public:
  static constexpr std::size_t kCapacity = std::size_t{60} * 600;  // ten minutes at 60 frames a second

  /// @param frame length of a frame [s]
  void start(const FrameReport& report, double frame);
  void add(const FrameReport& report);

  [[nodiscard]] std::span<const float> operator[](Channel channel) const {
    return channels_[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] std::size_t size() const { return channels_[0].size(); }
  /// Time at the end of the frame of sample i [s]; the samples lie one frame apart.
  [[nodiscard]] double time(std::size_t i) const {
    return first_time_ + static_cast<double>(i) * frame_;
  }
  [[nodiscard]] double end_time() const { return size() == 0 ? start_time_ : time(size() - 1); }
  [[nodiscard]] double frame() const { return frame_; }

 private:
  std::vector<float>& channel(Channel c) { return channels_[static_cast<std::size_t>(c)]; }

  std::array<std::vector<float>, static_cast<std::size_t>(Channel::kCount)> channels_;
  double frame_ = 1.0 / 60.0;
  double start_time_ = 0.0;
  double first_time_ = 0.0;
  double energy_at_start_ = 0.0;
};

}  // namespace substep
