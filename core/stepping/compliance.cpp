#include "core/stepping/compliance.hpp"

#include <algorithm>

#include "core/constraints/grab_rows.hpp"
#include "core/stepping/drift.hpp"

namespace substep {

namespace {

/// w+ = w- of a resolved spring, or nothing if only the force at the end is used.
double resolved_weight(const Settings& settings) {
  if (settings.solver == SolverKind::kNewton) {
    switch (settings.forces) {
      case Forces::kEnd:
        return 1.0;
      case Forces::kMean:
        return 1.0 / 4.0;
      case Forces::kNumerov:
        return 1.0 / 12.0;
    }
  }
  if (settings.integrator == Integrator::kEuler) return 1.0;
  const bool stormer = follows_accelerations(settings) && drift_law(settings) == Drift::kFull;
  return stormer ? 0.0 : 1.0 / 12.0;
}

/// (J Mt^-1 J^T)_ii of a row, over both bodies [1/kg or 1/(kg m^2)].
double mobility(const Block& joint, int row, std::span<const InverseMass> inverse_mass) {
  double sum = 0.0;
  for (const bool of_a : {true, false}) {
    const int body = of_a ? joint.a : joint.b;
    if (body < 0) continue;
    const InverseMass& W = inverse_mass[index(body)];
    const Vec6 J = gradient(joint, row, of_a);
    const Vec3 turn = J.tail<3>();
    sum += W.linear * J.head<3>().squaredNorm() + turn.dot(W.angular * turn);
  }
  return sum;
}

void set_joint_springs(const Substep& sub, const State& state) {
  const double rate = drift_rate(drift_law(sub.settings), sub.settings.drift_tau, sub.dt);
  const bool stored = springs_are_stored(sub);
  if (!stored && !averages_springs(sub.settings)) return;  // plain Eq. 3
  for (Block& block : sub.rows) {
    if (block.is_contact() || is_grab(block)) continue;
    const SubstepTimes times{sub.dt, dt_previous_of(state, block), impulse_time_of(sub, block)};
    // At the start and after the probe, all of phi is elastic.
    const bool known = stored && block.seeded && times.dt_previous > 0.0;
    if (!known) std::copy_n(block.phi, kMaxRows, block.elastic);
    set_springs(sub.settings, times, rate, sub.inverse_mass, sub.u_start, sub.scene->regularisation,
                block);
  }
}

void set_contact_springs(const Substep& sub, const State& state) {
  if (sub.scene->contact.compliance < kSoftContact || drift_law(sub.settings) != Drift::kFull ||
      !averages_springs(sub.settings)) {
    return;
  }
  for (Block& block : sub.rows) {
    if (!block.is_contact()) continue;
    const SubstepTimes times{sub.dt, dt_previous_of(state, block), impulse_time_of(sub, block)};
    set_contact_spring(sub.settings, times, sub.inverse_mass, sub.u_start,
                       sub.scene->regularisation, block);
  }
}

const Settings kLeapfrog = [] {
  Settings settings;
  settings.integrator = Integrator::kLeapfrog;
  return settings;
}();

}  // namespace

bool averages_springs(const Settings& settings) { return resolved_weight(settings) < 1.0; }

SpringWeights spring_weights(const Settings& settings, double kappa) {
  const double resolved = resolved_weight(settings);
  if (resolved == 1.0) return {1.0, 0.0};
  const double square = kappa * kappa;
  const double sigma = square < 1e12 ? square / (square + 4.0) : 1.0;
  const double sum = 2.0 * resolved + (1.0 - 2.0 * resolved) * sigma;
  if (resolved == 0.0 && kappa < kResolved) return {0.0, 0.0};
  return {0.5 * (sum + sigma), 0.5 * (sum - sigma)};
}

double spring_kappa(const SubstepTimes& times, std::span<const InverseMass> inverse_mass,
                    const Block& joint, int first, int end) {
  double most = 0.0;
  for (int row = first; row < end; ++row) {
    most = std::max(most, mobility(joint, row, inverse_mass));
  }
  return times.dt * times.force_time * most / joint.C[first];
}

void give_force(Block& joint, int row, double impulse) {
  joint.given[row] = impulse;
  joint.bias[row] = 0.0;
  joint.softness[row] = kGivenForce;
}

void set_springs(const Settings& settings, const SubstepTimes& times, double drift_rate,
                 std::span<const InverseMass> inverse_mass, std::span<const Vec6> u_before,
                 double regularisation, Block& joint) {
  double speed[kMaxRows] = {};
  if (averages_springs(settings)) row_speeds(joint, u_before, speed);
  const auto set_rows = [&](int first, int end) {  // rows with a common compliance
    const double C = joint.C[first];
    for (int row = first; row < end; ++row) joint.spring_ahead[row] = joint.given[row] = 0.0;
    if (!(C > 0.0)) return;
    const double step = times.dt * times.force_time;
    const SpringWeights w =
        spring_weights(settings, spring_kappa(times, inverse_mass, joint, first, end));
    for (int row = first; row < end; ++row) {
      const double elastic = joint.elastic[row];
      if (w.ahead == 0.0) {
        give_force(joint, row, -times.force_time * elastic / C);
        continue;
      }
      const double behind = w.behind * times.dt_previous * speed[row];
      joint.bias[row] =
          drift_rate * (joint.phi[row] - elastic) + (elastic - behind) / (w.ahead * times.dt);
      joint.softness[row] = C / (w.ahead * step) + regularisation;
      joint.spring_ahead[row] = w.ahead;
      joint.spring_rest[row] = (1.0 - w.ahead) * elastic - behind;
    }
  };
  set_rows(0, joint.position_rows);
  set_rows(joint.position_rows, joint.rows);
}

// The solver determines whether the contact pushes, so forces are never prescribed. An open contact
// at the pose behind exerts no tension: otherwise an impact would gain energy. If the contact opens
// ahead, the mean is truncated and slightly dissipative.
void set_contact_spring(const Settings& settings, const SubstepTimes& times,
                        std::span<const InverseMass> inverse_mass, std::span<const Vec6> u_before,
                        double regularisation, Block& contact) {
  const double kappa = spring_kappa(times, inverse_mass, contact, 0, 1);
  if (!(kappa < kResolvedContact)) return;
  SpringWeights w = spring_weights(settings, kappa);
  if (w.ahead == 0.0) w = spring_weights(kLeapfrog, kappa);
  double speed[kMaxRows];
  row_speeds(contact, u_before, speed);
  const double ahead = w.ahead * times.dt;
  const double phi = contact.phi[0];
  const double pressed = std::min(phi, 0.0);
  const double pressed_behind = std::min(phi - times.dt_previous * speed[0], 0.0);
  contact.bias[0] =
      (w.ahead * phi + (1.0 - w.ahead - w.behind) * pressed + w.behind * pressed_behind) / ahead;
  contact.softness[0] = contact.C[0] / (ahead * times.force_time) + regularisation;
  contact.spring_ahead[0] = w.ahead;
}

void set_springs(const Substep& sub, const State& state) {
  if (sub.has_springs) set_joint_springs(sub, state);
  if (sub.scene->effects.contact) set_contact_springs(sub, state);
}

void store_elastic(const double* lambda, Block& joint) {
  for (int row = 0; row < joint.rows; ++row) {
    joint.elastic[row] =
        joint.spring_ahead[row] > 0.0
            ? -(joint.C[row] * lambda[row] + joint.spring_rest[row]) / joint.spring_ahead[row]
            : 0.0;
  }
}

}  // namespace substep
