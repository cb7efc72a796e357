#include "app/history.hpp"

#include <cmath>

namespace substep {

void History::start(const FrameReport& report, double frame) {
  for (auto& values : channels_) values.clear();
  frame_ = frame;
  start_time_ = report.time;
  first_time_ = report.time + frame;
  energy_at_start_ = report.energy;
}

void History::add(const FrameReport& report) {
  // Forgotten a tenth at a time: the samples stay contiguous and adding one stays cheap.
  if (size() >= kCapacity) {
    constexpr std::size_t kForgotten = kCapacity / 10;
    for (auto& values : channels_) {
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kForgotten));
    }
    first_time_ += static_cast<double>(kForgotten) * frame_;
  }
  const auto add_to = [this](Channel c, double value) {
    channel(c).push_back(static_cast<float>(value));
  };
  add_to(Channel::kSubsteps, report.n_substeps);
  add_to(Channel::kLimit, 0.5 * frame_ * std::sqrt(report.leader.r));  // Eqs. 10, 11, alpha = 1
  add_to(Channel::kKinetic, report.kinetic);
  add_to(Channel::kEnergyChange, report.energy - energy_at_start_);
  add_to(Channel::kJointError, report.constraint_error);
  add_to(Channel::kPenetration, report.penetration);
  add_to(Channel::kTime, 1e3 * report.times.total);
}

}  // namespace substep
