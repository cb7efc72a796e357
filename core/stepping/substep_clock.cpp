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
  return mode == Mode::kAdaptive || mode == Mode::kCapped || mode == Mode::kInertia ||
         mode == Mode::kBlend;
}

bool has_islands(const Settings& settings) {
  return settings.islands && chooses_substeps(settings.mode);
}

bool looks_for_islands(const Settings& settings) { return has_islands(settings) || settings.sleep; }

int wanted_substeps(double h, double dt_max) {
  constexpr double kMost = 1e9;  // an impulsive force can ask for more than an int holds
  const double n = std::ceil(h / dt_max);
  return n >= 1.0 ? static_cast<int>(std::min(n, kMost)) : 1;
}

namespace {

bool decides_again(const Settings& settings) {
  return settings.policy == Policy::kSubstep && chooses_substeps(settings.mode);
}

}  // namespace

double remembered(const Settings& settings, double now, double before) {
  return decides_again(settings) ? std::max(now, settings.memory * before) : now;
}

SubstepClock::SubstepClock(const Settings& settings, double h, double r)
    : settings_(settings), h_(h), rest_(h), r_(r) {
  assert(settings.n >= 1 && settings.n_max >= 1 && settings.n_cap >= 1 && "a frame has a sub-step");
  decide();
}

void SubstepClock::decide() {
  switch (settings_.mode) {
    case Mode::kNone:
    case Mode::kDamping:
    case Mode::kStiffness:
      left_ = 1;
      break;
    case Mode::kConst:
      left_ = settings_.n;
      break;
    case Mode::kAdaptive:
    case Mode::kCapped:
    case Mode::kInertia:
    case Mode::kBlend: {
      limit_ = settings_.mode == Mode::kAdaptive ? settings_.n_max : settings_.n_cap;
      const double dt_max = stable_step(settings_.alpha, r_);
      const int wanted = wanted_substeps(h_, dt_max);
      n_wanted_ = std::max(n_wanted_, wanted);
      capped_ = capped_ || wanted > limit_;
      // Rounding must not take the quotient of the cap one too high.
      left_ = std::min(wanted_substeps(rest_, dt_max), limit_ - taken_);
      break;
    }
  }
  dt_ = rest_ / left_;
}

bool SubstepClock::needs_stiffness() const {
  switch (settings_.mode) {
    case Mode::kNone:
    case Mode::kConst:
      return settings_.watch_stiffness && left_ == 1;
    case Mode::kDamping:
    case Mode::kCapped:
    case Mode::kStiffness:
    case Mode::kInertia:
    case Mode::kBlend:
      return true;
    case Mode::kAdaptive:
      return left_ == 1 || settings_.policy == Policy::kSubstep;
  }
  return false;
}

void SubstepClock::advance(double r) {
  if (needs_stiffness()) r_ = remembered(settings_, r, r_);
  ++taken_;
  if (--left_ == 0) return;
  if (decides_again(settings_)) {
    rest_ -= dt_;
    decide();
  }
}

}  // namespace substep
