#include "core/stepping/substep_clock.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace substep {

double stable_step(double alpha, double r) {
  return r > 0.0 ? 2.0 * std::sqrt(alpha / r) : std::numeric_limits<double>::infinity();
}

bool chooses_substeps(Mode mode) {
  const SubstepCount count = entry_of(mode).count;
  return count == SubstepCount::kStable || count == SubstepCount::kStableCapped;
}

bool has_islands(const Settings& settings) {
  return settings.islands && chooses_substeps(settings.mode);
}

bool looks_for_islands(const Settings& settings) { return has_islands(settings) || settings.sleep; }

bool watches_substeps(const Settings& settings) {
  return chooses_substeps(settings.mode) && (settings.redo || settings.hold > 1);
}

int wanted_substeps(double h, double dt_max) {
  constexpr double kMost = 1e9;  // an impulsive force can require more than fits in an int
  const double n = std::ceil(h / dt_max);
  return n >= 1.0 ? static_cast<int>(std::min(n, kMost)) : 1;
}

bool decides_again(const Settings& settings) {
  return settings.policy == Policy::kSubstep && chooses_substeps(settings.mode);
}

double remembered(const Settings& settings, double now, double before) {
  return decides_again(settings) ? std::max(now, settings.memory * before) : now;
}

SubstepClock::SubstepClock(const Settings& settings, double h, double r, double r_rotation,
                           double r_least)
    : settings_(settings), h_(h), rest_(h), r_(r), r_rotation_(r_rotation), r_least_(r_least) {
  assert(settings.n >= 1 && settings.n_max >= 1 && settings.n_cap >= 1 && "a frame has a sub-step");
  decide();
}

void SubstepClock::decide() {
  const SubstepCount count = entry_of(settings_.mode).count;
  left_ = count == SubstepCount::kGiven ? settings_.n : 1;
  if (chooses_substeps(settings_.mode)) {
    const int limit = count == SubstepCount::kStable ? settings_.n_max : settings_.n_cap;
    const double dt_max = stable_step(settings_.alpha, std::max({r_, r_rotation_, r_least_}));
    const int wanted = wanted_substeps(h_, dt_max);
    n_wanted_ = std::max(n_wanted_, wanted);
    capped_ = capped_ || wanted > limit;
    // Rounding must not push the quotient above the cap.
    left_ = std::min(wanted_substeps(rest_, dt_max), limit - (taken_ - shortened_));
  }
  dt_ = rest_ / left_;
  planned_ = shortened_ > 0 ? std::max(planned_, dt_) : dt_;
}

bool SubstepClock::needs_stiffness() const {
  if (changes_mass(settings_.mode)) return true;
  if (decides_again(settings_) || watches_substeps(settings_)) return true;
  return left_ == 1 && (chooses_substeps(settings_.mode) || settings_.watch_stiffness);
}

bool SubstepClock::may_shorten(int few) const {
  const int planned = taken_ - shortened_ + left_;
  return shortens_ || shortened_ < std::max(few, planned / 4);
}

void SubstepClock::shorten(double dt) {
  if (!shortens_ && !decides_again(settings_)) rest_ = left_ * dt_;  // of equal ones
  if (!shortens_) ++shortened_;
  shortens_ = true;
  dt_ = dt;
}

void SubstepClock::advance(double r, double r_rotation) {
  r_rotation_ = r_rotation;
  if (chooses_substeps(settings_.mode) && settings_.redo) {
    constexpr double kRounding = 1e-9;  // without it the same N could be required again
    exceeded_ = exceeded_ ||
                dt_ > (1.0 + kRounding) * stable_step(settings_.alpha, std::max(r, r_rotation));
  }
  if (needs_stiffness()) r_ = remembered(settings_, r, r_);
  ++taken_;
  if (!shortens_ && --left_ == 0) return;
  if (!shortens_ && !decides_again(settings_)) return;
  rest_ -= dt_;
  dt_ = rest_ / left_;
  shortens_ = false;
  if (decides_again(settings_)) decide();
}

}  // namespace substep
