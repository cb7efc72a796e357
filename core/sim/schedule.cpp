#include "core/sim/schedule.hpp"

#include <algorithm>

namespace substep {

void Schedule::clear() {
  turns_.clear();
  at_ = 0;
}

void Schedule::add(const Part& part, const SubstepClock& clock) {
  turns_.push_back({&part, clock});
}

void Schedule::advance(double r, double r_rotation) {
  SubstepClock& clock = turns_[at_].clock;
  clock.advance(r, r_rotation);
  if (!clock.running()) ++at_;
}

int Schedule::left() const {
  int sum = 0;
  for (std::size_t i = at_; i < turns_.size(); ++i) sum += turns_[i].clock.left();
  return sum;
}

bool Schedule::moves(int body) const {
  return std::any_of(turns_.begin(), turns_.end(),
                     [&](const Turn& turn) { return turn.part->holds(body); });
}

double Schedule::r() const {
  double most = 0.0;
  for (const Turn& turn : turns_) most = std::max(most, turn.clock.r());
  return most;
}

int Schedule::n_wanted() const {
  int most = 1;
  for (const Turn& turn : turns_) most = std::max(most, turn.clock.n_wanted());
  return most;
}

bool Schedule::capped() const {
  return std::any_of(turns_.begin(), turns_.end(),
                     [](const Turn& turn) { return turn.clock.capped(); });
}

}  // namespace substep
