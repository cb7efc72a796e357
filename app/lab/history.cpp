#include "app/lab/history.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace substep {

void Extent::add(float value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
  if (value > 0.0F) least_positive = std::min(least_positive, value);
}

void Extent::add(const Extent& other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
  least_positive = std::min(least_positive, other.least_positive);
}

void Samples::clear() {
  values_.clear();
  for (auto& level : levels_) level.clear();
}

void Samples::push_back(float value) {
  std::size_t block = kFan;
  for (auto& level : levels_) {
    if (values_.size() % block == 0) level.emplace_back();
    level.back().add(value);
    block *= kFan;
  }
  values_.push_back(value);
}

void Samples::drop_front(std::size_t count) {
  assert(count % kLargestBlock == 0 && "blocks stay whole");
  const auto erase = [](auto& list, std::size_t n) {
    list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(std::min(n, list.size())));
  };
  erase(values_, count);
  for (auto& level : levels_) erase(level, count /= kFan);
}

void Samples::truncate(std::size_t count) {
  if (count >= values_.size()) return;
  // The last block is rebuilt from its remaining samples.
  const std::size_t whole = count / kLargestBlock * kLargestBlock;
  const std::vector<float> rest(values_.begin() + static_cast<std::ptrdiff_t>(whole),
                                values_.begin() + static_cast<std::ptrdiff_t>(count));
  values_.resize(whole);
  std::size_t blocks = whole;
  for (auto& level : levels_) level.resize(blocks /= kFan);
  for (const float value : rest) push_back(value);
}

Extent Samples::extent(std::size_t first, std::size_t last) const {
  last = std::min(last, values_.size());
  Extent extent;
  while (first < last) {
    // The largest block that starts here and ends before `last`.
    std::size_t block = 1;
    std::size_t level = 0;
    while (level < kLevels && first % (block * kFan) == 0 && first + block * kFan <= last) {
      block *= kFan;
      ++level;
    }
    if (level == 0) {
      extent.add(values_[first]);
    } else {
      extent.add(levels_[level - 1][first / block]);
    }
    first += block;
  }
  return extent;
}

void History::start(const FrameReport& report, double frame, double exchanged) {
  for (Samples& samples : channels_) samples.clear();
  frame_ = frame;
  start_time_ = report.time;
  first_time_ = report.time + frame;
  energy_at_start_ = report.energy;
  potential_at_start_ = report.potential;
  exchanged_ = exchanged;
}

void History::add(const FrameReport& report, double put_in) {
  // A tenth is dropped at a time: samples stay contiguous and adding one stays cheap.
  if (size() >= kCapacity) {
    constexpr std::size_t kBlock = Samples::kLargestBlock;
    constexpr std::size_t kForgotten = kCapacity / 10 / kBlock * kBlock;
    for (Samples& samples : channels_) samples.drop_front(kForgotten);
    first_time_ += static_cast<double>(kForgotten) * frame_;
  }
  const auto add_to = [this](Channel c, double value) {
    channels_[static_cast<std::size_t>(c)].push_back(static_cast<float>(value));
  };
  add_to(Channel::kSubsteps, report.n_substeps);
  add_to(Channel::kMean, report.n_mean);
  add_to(Channel::kLimit, 0.5 * frame_ * std::sqrt(report.leader.r));  // Eqs. 10, 11, alpha = 1
  add_to(Channel::kKinetic, report.kinetic);
  add_to(Channel::kPotential, report.potential - potential_at_start_);
  add_to(Channel::kElastic, report.springs);
  add_to(Channel::kTotal,
         report.kinetic + (report.potential - potential_at_start_) + report.springs);
  add_to(Channel::kPutIn, put_in);
  // Subtract in double precision: a drift is many orders smaller than the energies.
  add_to(Channel::kDrift, report.energy - energy_at_start_ - put_in);
  add_to(Channel::kJointError, report.constraint_error);
  add_to(Channel::kJointGap, report.joint_gap);
  add_to(Channel::kPenetration, report.penetration);
  add_to(Channel::kTime, 1e3 * report.times.total);
  add_to(Channel::kTimeSolve, 1e3 * report.times.solve);
  add_to(Channel::kTimeJoints, 1e3 * report.times.joints);
  add_to(Channel::kTimeContact, 1e3 * report.times.contact);
  add_to(Channel::kTimeFriction, 1e3 * report.times.friction);
  add_to(Channel::kTimeStiffness, 1e3 * report.times.stiffness);
}

bool History::has_springs() const {
  return samples(Channel::kElastic).extent(0, size()).high > 0.0F;
}

double History::largest_size(Channel channel) const {
  const Extent all = samples(channel).extent(0, size());
  return all.empty() ? 0.0 : static_cast<double>(std::max(-all.low, all.high));
}

double History::largest_drift() const { return largest_size(Channel::kDrift); }

double History::largest_potential() const { return largest_size(Channel::kPotential); }

double History::largest_kinetic() const {
  const Extent all = samples(Channel::kKinetic).extent(0, size());
  return all.empty() ? 0.0 : static_cast<double>(all.high);
}

void History::cut(double time) {
  const double count = std::floor((time - first_time_) / frame_ + 0.5) + 1.0;
  const auto kept = static_cast<std::size_t>(std::clamp(count, 0.0, static_cast<double>(size())));
  for (Samples& samples : channels_) samples.truncate(kept);
}

History::Slice History::between(double t0, double t1) const {
  const auto count = static_cast<double>(size());
  const double first = std::floor((t0 - first_time_) / frame_);
  const double last = std::ceil((t1 - first_time_) / frame_) + 1.0;
  return {static_cast<std::size_t>(std::clamp(first, 0.0, count)),
          static_cast<std::size_t>(std::clamp(last, 0.0, count))};
}

double History::at(Channel channel, double time) const {
  const double i = std::round((time - first_time_) / frame_);
  if (!(i >= 0.0) || i >= static_cast<double>(size())) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return static_cast<double>((*this)[channel][static_cast<std::size_t>(i)]);
}

}  // namespace substep
