#include "core/stepping/armature.hpp"

#include "core/constraints/contact.hpp"
#include "core/model/methods.hpp"
#include "core/stepping/drift.hpp"

namespace substep {

void set_armature_at_rate(double rate, double regularisation, Block& row) {
  row.softness[0] = 1.0 / row.armature + regularisation;
  row.bias[0] = -rate;
  row.hi = kAnyEffort;
  row.lo = -kAnyEffort;
}

double rate_before(const Substep& sub, const Block& row) {
  return row.seeded ? row.elastic[0] : normal_speed(row, sub.u_start);
}

void set_armature(const Substep& sub, std::span<const Vec6> u, Block& row) {
  // Impacts at the start of the sub-step changed the rate.
  const double rate =
      rate_before(sub, row) + normal_speed(row, sub.u_before) - normal_speed(row, sub.u_unstruck);
  set_armature_at_rate(rate, sub.scene->regularisation, row);
  row.elastic[0] = rate;
  if (sub.probing || entry_of(sub.settings.solver).at_end || aims_at_poses(sub.settings)) return;
  double curvature[kMaxRows];
  curvature_of(row, u, curvature);
  row.bias[0] += 0.5 * sub.dt * curvature[0];
}

double rate_after(const Substep& sub, const Block& row) {
  return sub.probing ? row.elastic[0] : row.elastic[0] - row.impulse[0] / row.armature;
}

double mobility_along(const Substep& sub, const Block& row) {
  const double of_bodies = mobility_of(row, 0, sub.inverse_mass);
  return of_bodies / (1.0 + row.armature * of_bodies);
}

}  // namespace substep
