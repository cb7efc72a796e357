#pragma once
// The reference for runs of the swinging box.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"

namespace substep::test {

/// The swinging box; the paper's joints have a small compliance [m/N, rad/(N m)].
inline Outcome swing(const Settings& settings, double seconds = 10.0, double compliance = 1e-12) {
  return run(scenes::swinging_box({scenes::kSixtyDegrees, compliance}), settings, seconds);
}
/// The same with exact joints.
inline Outcome swing_exact(const Settings& settings, double seconds = 10.0) {
  return swing(settings, seconds, 0.0);
}

inline constexpr double kExchanged = 51500.0;  // exchanged energy: 100 % of the drift [J]

/// Centre of the heavy box in the exact motion, 60 Hz, 10 s.
inline const std::vector<Vec3>& reference() {
  static const std::vector<Vec3> rows = [] {
    std::ifstream file(SUBSTEP_SOURCE_DIR "/tests/reference/reference_swinging_box.csv");
    std::vector<Vec3> out;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream fields(line);
      double t = 0.0;
      Vec3 x = Vec3::Zero();
      fields >> t >> x.x() >> x.y();
      out.push_back(x);
    }
    return out;
  }();
  return rows;
}

/// Largest distance of the heavy box from the exact motion [m].
inline double tip_error(const Outcome& run) {
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(run.track.size(), reference().size()); ++i) {
    keep_largest(worst, (run.track[i] - reference()[i]).norm());
  }
  return worst;
}

inline double energy_drift_percent(const Outcome& run) {
  return 100.0 * (run.energy_end - run.energy_start) / kExchanged;
}

}  // namespace substep::test
