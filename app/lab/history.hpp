#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/sim/report.hpp"

namespace substep {

/// What the plots show, one number a frame.
enum class Channel : std::uint8_t {
  kSubsteps,     // N taken, by the island that took most [-]
  kMean,         // of the bodies: less where islands have their own N [-]
  kLimit,        // N at alpha = 1: fewer than this is unstable [-], 0 where K is not known
  kKinetic,      // [J]
  kPotential,    // minus that at the start [J]
  kTotal,        // the sum of these two [J]
  kDrift,        // change of the total energy since the start: 0, ideally [J]
  kJointError,   // sum over joints of the 1-norm of phi [m, rad]
  kJointGap,     // largest distance between the anchors of a joint [m]
  kPenetration,  // largest overlap of a contact [m]
  kTime,         // wall time of the frame [ms]
  kTimeSolve,    // of it, by stage [ms]
  kTimeJoints,
  kTimeContact,
  kTimeFriction,
  kTimeStiffness,
  kCount
};

/// Least and greatest of some samples; what is not finite is left out.
struct Extent {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
  float least_positive = std::numeric_limits<float>::infinity();  // for logarithmic axes

  void add(float value);
  void add(const Extent& other);
  [[nodiscard]] bool empty() const { return low > high; }
};

/// Samples with the extents of blocks of 8, 64 and 512 of them: the extent of any stretch costs
/// some tens of steps, however long it is.
class Samples {
 public:
  static constexpr std::size_t kFan = 8;
  static constexpr std::size_t kLevels = 3;
  static constexpr std::size_t kLargestBlock = kFan * kFan * kFan;

  void clear();
  void push_back(float value);
  /// Drops the oldest. @param count a multiple of kLargestBlock
  void drop_front(std::size_t count);
  /// Keeps the oldest `count`.
  void truncate(std::size_t count);
  [[nodiscard]] std::span<const float> values() const { return values_; }
  /// Of the samples [first, last).
  [[nodiscard]] Extent extent(std::size_t first, std::size_t last) const;

 private:
  std::vector<float> values_;
  std::array<std::vector<Extent>, kLevels> levels_;  // of whole and of begun blocks
};

/// The last minutes of a run, one sample a frame, oldest first and contiguous.
class History {
 public:
  static constexpr std::size_t kCapacity =
      std::size_t{60} * 600;  // ten minutes at 60 frames a second

  /// @param frame length of a frame [s]
  void start(const FrameReport& report, double frame);
  void add(const FrameReport& report);
  /// Forgets what is later than `time` [s].
  void cut(double time);

  [[nodiscard]] std::span<const float> operator[](Channel channel) const {
    return samples(channel).values();
  }
  [[nodiscard]] const Samples& samples(Channel channel) const {
    return channels_[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] std::size_t size() const { return channels_[0].values().size(); }
  /// Time at the end of the frame of sample i [s]; the samples lie one frame apart.
  [[nodiscard]] double time(std::size_t i) const {
    return first_time_ + static_cast<double>(i) * frame_;
  }
  /// The samples at and between two times, as [first, last); one more to either side where there
  /// is one, so that a line continues over the edge.
  struct Slice {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  [[nodiscard]] Slice between(double t0, double t1) const;
  /// Value of the sample nearest to a time. NaN where there is none within a frame.
  [[nodiscard]] double at(Channel channel, double time) const;
  [[nodiscard]] double potential_at_start() const { return potential_at_start_; }  ///< [J]
  /// What the samples of the potential count from so that the lowest is 0, added to them and to
  /// those of the total [J]. The zero of a potential is free; this one keeps kinetic, potential
  /// and total energy on one readable scale.
  [[nodiscard]] double potential_offset() const;
  /// The largest change of the total energy so far, up or down [J].
  [[nodiscard]] double largest_drift() const;
  /// The largest kinetic energy so far [J].
  [[nodiscard]] double largest_kinetic() const;
  [[nodiscard]] double start_time() const { return start_time_; }
  [[nodiscard]] double end_time() const { return size() == 0 ? start_time_ : time(size() - 1); }
  [[nodiscard]] double frame() const { return frame_; }

 private:
  std::array<Samples, static_cast<std::size_t>(Channel::kCount)> channels_;
  double frame_ = 1.0 / 60.0;
  double start_time_ = 0.0;
  double first_time_ = 0.0;
  double energy_at_start_ = 0.0;
  double potential_at_start_ = 0.0;
};

}  // namespace substep
