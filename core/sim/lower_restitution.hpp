#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Work of the impulses of all contacts.
struct ContactWork {
  double added = 0.0;      // to the kinetic energy [J]
  double exchanged = 0.0;  // sum of magnitudes [J]
  [[nodiscard]] bool adds() const { return added > 1e-9 * exchanged; }
};

/// Where friction acts or restitutions differ, Newton's law can add energy (Kane and Levinson
/// 1985). All e of the impact are then lowered to about the largest share with which it adds none.
/// Without rebound an impact never does: its work impulse . (w + w+)/2 is impulse . w+ - impulse .
/// A impulse/2, and each row's impulse . w+ <= 0.
/// @param full work with share 1  @param solve(share) solves the impact; false: refused
/// @param work() of the last solve  @param u velocities after it  @param best scratch
/// @return the share, whose velocities are in u; nothing if a solve was refused
template <class Solve, class Work>
std::optional<double> lower_restitution(const ContactWork& full, const Solve& solve,
                                        const Work& work, std::span<Vec6> u,
                                        std::vector<Vec6>& best) {
  constexpr int kMostTrials = 8;
  constexpr double kClose = 1e-4;
  double high = 1.0;
  double added_at_high = full.added;
  double low = 0.0;
  double added_at_low = 0.0;
  double share = 0.0;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    if (!solve(share)) return std::nullopt;
    const double added = work().added;
    if (added <= 0.0 || trial == 0) {
      best.assign(u.begin(), u.end());
      low = share;
      added_at_low = added;
      if (added >= -kClose * full.exchanged) break;
      if (trial > 1) added_at_high *= 0.5;  // Illinois: the chord of a convex function stays below
    } else {
      high = share;
      added_at_high = added;
    }
    share = low - added_at_low * (high - low) / (added_at_high - added_at_low);
  }
  copy(best, u);
  return low;
}

}  // namespace substep
