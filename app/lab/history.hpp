#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/sim/report.hpp"

namespace substep {

/// Quantities that the plots show, one value per frame.
enum class Channel : std::uint8_t {
  kSubsteps,     // N taken, of the island with the most [-]
  kMean,         // mean over the bodies: smaller if islands have their own N [-]
  kLimit,        // N at alpha = 1: fewer is unstable [-], 0 if K is not known
  kKinetic,      // [J]
  kPotential,    // minus that at the start [J]
  kElastic,      // in springs and soft contacts [J]
  kTotal,        // the sum of these three [J]
  kPutIn,        // work of the user since the start: throws, pulls, edits [J]
  kDrift,        // change of the total energy since the start, without that work: 0, ideally [J]
  kJointError,   // sum of |phi| of joint rows, springs excepted [m, rad]
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

/// Minimum and maximum of samples; ignores values that are not finite.
struct Extent {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
  float least_positive = std::numeric_limits<float>::infinity();  // for logarithmic axes

  void add(float value);
  void add(const Extent& other);
  [[nodiscard]] bool empty() const { return low > high; }
};

/// Samples with the extents of blocks of 8, 64 and 512: the extent of a range of any length takes
/// some tens of steps.
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
  /// Extent of the samples [first, last).
  [[nodiscard]] Extent extent(std::size_t first, std::size_t last) const;

 private:
  std::vector<float> values_;
  std::array<std::vector<Extent>, kLevels> levels_;  // of complete and partial blocks
};

/// The last minutes of a run, one sample per frame, oldest first and contiguous.
class History {
 public:
  static constexpr std::size_t kCapacity =
      std::size_t{60} * 600;  // ten minutes at 60 frames a second

  /// @param frame duration of a frame [s]
  /// @param exchanged energy that the scene says its motion exchanges [J], 0 if it says none
  void start(const FrameReport& report, double frame, double exchanged = 0.0);
  /// @param put_in work of the user since the start [J]
  void add(const FrameReport& report, double put_in = 0.0);
  /// Discards samples later than `time` [s].
  void cut(double time);

  [[nodiscard]] std::span<const float> operator[](Channel channel) const {
    return samples(channel).values();
  }
  [[nodiscard]] const Samples& samples(Channel channel) const {
    return channels_[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] std::size_t size() const { return channels_[0].values().size(); }
  /// Time at the end of the frame of sample i [s]; samples are one frame apart.
  [[nodiscard]] double time(std::size_t i) const {
    return first_time_ + static_cast<double>(i) * frame_;
  }
  /// The samples between two times, as [first, last), extended by one on either side if there is
  /// one, so that a line continues past the edge.
  struct Slice {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  [[nodiscard]] Slice between(double t0, double t1) const;
  /// Value of the sample nearest to a time; NaN if there is none within a frame.
  [[nodiscard]] double at(Channel channel, double time) const;
  [[nodiscard]] double potential_at_start() const { return potential_at_start_; }  ///< [J]
  /// The potential energy at the start in the plots, added to the samples of the potential and of
  /// the total [J]: what the scene says its motion exchanges, so that the lowest point is near
  /// zero, else zero. It never changes during a run.
  [[nodiscard]] double potential_offset() const { return exchanged_; }
  /// Whether springs or soft contacts have held energy so far.
  [[nodiscard]] bool has_springs() const;
  /// Largest absolute change of the total energy so far [J].
  [[nodiscard]] double largest_drift() const;
  /// Largest absolute change of the potential energy since the start so far [J].
  [[nodiscard]] double largest_potential() const;
  /// Largest kinetic energy so far [J].
  [[nodiscard]] double largest_kinetic() const;
  [[nodiscard]] double start_time() const { return start_time_; }
  [[nodiscard]] double end_time() const { return size() == 0 ? start_time_ : time(size() - 1); }
  [[nodiscard]] double frame() const { return frame_; }

 private:
  /// Largest absolute value so far.
  [[nodiscard]] double largest_size(Channel channel) const;

  std::array<Samples, static_cast<std::size_t>(Channel::kCount)> channels_;
  double frame_ = 1.0 / 60.0;
  double start_time_ = 0.0;
  double first_time_ = 0.0;
  double energy_at_start_ = 0.0;
  double potential_at_start_ = 0.0;
  double exchanged_ = 0.0;  // energy that the motion is known to exchange [J]
};

}  // namespace substep
