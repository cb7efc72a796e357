#include "core/stepping/drive.hpp"

#include <algorithm>
#include <cmath>

#include "core/constraints/coordinate_stage.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/compliance.hpp"

namespace substep {
namespace {

/// Means over the poses around a sub-step: of phi, phi + ahead (J u+) + behind, and of the speed,
/// share (J u+) + rest.
struct DriveMeans {
  double ahead = 0.0;   // [s]
  double behind = 0.0;  // [m or rad]
  double share = 1.0;   // [-]
  double rest = 0.0;    // [m/s or rad/s]
};

void set_drive_row(const Drive& drive, const DriveMeans& means, double time, double regularisation,
                   Block& row) {
  constexpr double kSoftest = 1e200;
  const double resistance = means.ahead * drive.stiffness + means.share * drive.damping;
  const double softness = 1.0 / (time * resistance);
  row.elastic[0] = coordinate_of(row);
  row.softness[0] = regularisation;
  row.bias[0] = row.lo = row.hi = 0.0;
  if (!(softness < kSoftest)) return;  // it has no force or no time
  const double phi = row.elastic[0] - drive.target;
  row.softness[0] += softness;
  row.bias[0] =
      (drive.stiffness * (phi + means.behind) + drive.damping * (means.rest - drive.velocity)) /
      resistance;
  row.hi = drive.effort ? *drive.effort * time : kAnyEffort;
  row.lo = -row.hi;
}

/// theta of the damper; 1 with implicit Euler. @param a c t/m
double share_of_speed(double dt, double dt_previous, double a) {
  constexpr double kLeast = 0.25;  // in the first sub-step, and where sub-steps grow
  const double here = std::max(kLeast, dt_previous / (dt_previous + dt));
  const double square = a * a;
  return here + (1.0 - here) * (square < 1e12 ? square / (square + 4.0) : 1.0);
}

}  // namespace

void set_drive(const Substep& sub, const State& state, const Drive& drive, std::span<const Vec6> u,
               Block& row) {
  const double time = impulse_time_of(sub, row);
  DriveMeans means{.ahead = sub.dt};
  if (averages_springs(sub.settings)) {
    const double dt_previous = dt_previous_of(state, row);
    const double per_effort = time * mobility_along(sub, row);
    double speed[kMaxRows];
    row_speeds(row, u, speed);
    const SpringWeights w = solved_weights(sub.settings, sub.dt * per_effort * drive.stiffness);
    means.ahead = w.ahead * sub.dt;
    means.behind = -w.behind * dt_previous * speed[0];
    means.share = share_of_speed(sub.dt, dt_previous, per_effort * drive.damping);
    means.rest = (1.0 - means.share) * speed[0];
  }
  set_drive_row(drive, means, time, sub.scene->regularisation, row);
}

// Implicit over its duration, so that a stiff one is bounded too.
void set_drive_reaction(const Substep& sub, const Drive& drive, double time, Block& row) {
  set_drive_row(drive, {.ahead = time}, time, sub.scene->regularisation, row);
}

double effort_at(const Drive& drive, double coordinate, double speed) {
  const double effort = drive.stiffness * std::abs(coordinate - drive.target) +
                        drive.damping * std::abs(speed - drive.velocity);
  return drive.effort ? std::min(effort, *drive.effort) : effort;
}

void set_joint_friction(const Substep& sub, double effort, double time, Block& row) {
  constexpr double kShares = 1e-9;
  const double softness = kShares * mobility_along(sub, row);
  row.hi = effort * time;
  row.lo = -row.hi;
  row.softness[0] = sub.scene->regularisation + softness;
  row.bias[0] = -softness * std::clamp(row.impulse[0], row.lo, row.hi);
}

}  // namespace substep
