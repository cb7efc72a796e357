#include "app/lab/timeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace substep {
namespace {

template <class T>
std::size_t held(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::size_t bytes_of(const Moment& m) {
  const State& s = m.state;
  return sizeof m + held(s.x) + held(s.q) + held(s.u) + held(s.k) + held(s.forces) + held(s.own) +
         held(s.rest) + held(s.rotation) + held(s.held) + held(s.acceleration) +
         held(s.acceleration_change) + held(s.torque) + held(s.torque_change) +
         held(s.K_resisting) + held(s.u_synchronised) + held(m.forces.joints) +
         held(m.forces.contacts);
}

}  // namespace

void Timeline::start(Moment moment) {
  moments_.clear();
  bytes_ = 0;
  add(std::move(moment));
}

void Timeline::add(Moment moment) {
  cut();
  bytes_ += bytes_of(moment);
  moments_.push_back(std::move(moment));
  if (bytes_ > most_bytes_) thin();
  index_ = moments_.size() - 1;
}

void Timeline::cut() {
  if (moments_.empty()) return;
  for (std::size_t i = index_ + 1; i < moments_.size(); ++i) bytes_ -= bytes_of(moments_[i]);
  moments_.erase(moments_.begin() + static_cast<std::ptrdiff_t>(index_) + 1, moments_.end());
}

void Timeline::go_to(std::size_t index) { index_ = std::min(index, moments_.size() - 1); }

std::size_t Timeline::at_time(double time) const {
  const auto after = std::lower_bound(moments_.begin(), moments_.end(), time,
                                      [](const Moment& m, double t) { return m.state.time < t; });
  if (after == moments_.begin()) return 0;
  const auto before = after - 1;
  const bool nearer =
      after != moments_.end() && after->state.time - time < time - before->state.time;
  return static_cast<std::size_t>((nearer ? after : before) - moments_.begin());
}

void Timeline::thin() {
  const std::size_t half = moments_.size() / 2;
  std::size_t at = 0;
  std::erase_if(moments_, [&](const Moment&) {
    const std::size_t i = at++;
    return i < half && i % 2 == 1;
  });
  bytes_ = std::accumulate(moments_.begin(), moments_.end(), std::size_t{0},
                           [](std::size_t sum, const Moment& m) { return sum + bytes_of(m); });
}

}  // namespace substep
