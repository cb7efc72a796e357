#include "core/stepping/compliance.hpp"

#include <algorithm>
#include <cmath>

#include "core/constraints/grab_rows.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/drift.hpp"

namespace substep {

namespace {

// Softness of a row with a prescribed impulse, of its mobility: J u is negligible beside it.
constexpr double kGivenForce = 1e12;

using Mobility = double[kMaxRows][kMaxRows];

/// Adds the lower triangle of J Mt^-1 J^T through one body.
void add_mobility(const Block& joint, int first, int end, bool of_a,
                  std::span<const InverseMass> inverse_mass, Mobility& sum) {
  const int body = of_a ? joint.a : joint.b;
  if (body < 0) return;
  const InverseMass& W = inverse_mass[index(body)];
  Vec6 J[kMaxRows];
  for (int i = 0; i < end - first; ++i) {
    J[i] = gradient(joint, first + i, of_a);
    const Vec3 moved = W.linear * J[i].head<3>();
    const Vec3 turned = W.angular * J[i].tail<3>();
    for (int j = 0; j <= i; ++j) {
      sum[i][j] += J[j].head<3>().dot(moved) + J[j].tail<3>().dot(turned);
    }
  }
}

/// From 0.85 to 1 of the largest eigenvalue mu of J Mt^-1 J^T: sqrt(sum mu^4 / sum mu^2). It does
/// not depend on the directions of the rows, which for a ball joint are those of the world.
double largest_mobility(const Block& joint, int first, int end,
                        std::span<const InverseMass> inverse_mass) {
  Mobility A = {};
  add_mobility(joint, first, end, true, inverse_mass, A);
  add_mobility(joint, first, end, false, inverse_mass, A);
  const int n = end - first;
  if (n == 1) return A[0][0];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) A[j][i] = A[i][j];
  }
  double squares = 0.0;
  double fourths = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double square = 0.0;  // of A^2
      for (int k = 0; k < n; ++k) square += A[i][k] * A[k][j];
      squares += A[i][j] * A[i][j];
      fourths += square * square;
    }
  }
  return squares > 0.0 ? std::sqrt(fourths / squares) : 0.0;
}

}  // namespace

double spring_kappa(double dt_t, std::span<const InverseMass> inverse_mass, const Block& joint,
                    int first, int end) {
  return dt_t * largest_mobility(joint, first, end, inverse_mass) / joint.C[first];
}

void give_force(std::span<const InverseMass> inverse_mass, Block& joint, int row, double impulse,
                double speed) {
  joint.given[row] = impulse;
  joint.bias[row] = -speed;
  joint.softness[row] = kGivenForce * mobility_of(joint, row, inverse_mass);
}

void stiffen_contacts(const Substep& sub, double share, std::span<Block> rows) {
  constexpr double kLimit = 1e-2;  // of a contact's: a limit has no other points to share with
  for (Block& block : rows) {
    if (!block.is_unilateral()) continue;
    for (int row = 0; row < block.rows; ++row) {
      if (block.C[row] >= sub.scene->contact.soft_compliance) continue;
      block.softness[row] = (block.is_contact() ? share * mobility_of(block, row, sub.inverse_mass)
                                                : kLimit * share * mobility_along(sub, block)) +
                            sub.scene->regularisation;
    }
  }
}

namespace {

// Largest kappa for which a contact spring is averaged: there its weights equal implicit Euler's to
// 1e-3.
constexpr double kResolvedContact = 100.0;

constexpr double kNumerov = 1.0 / 12.0;

/// w+ = w- of a resolved spring; 1 if only the force at the end is used.
double resolved_weight(const Settings& settings) {
  if (settings.solver == SolverKind::kNewton) {
    switch (settings.forces) {
      case Forces::kEnd:
        return 1.0;
      case Forces::kMean:
        return 1.0 / 4.0;
      case Forces::kNumerov:
        return kNumerov;
    }
  }
  if (settings.integrator == Integrator::kEuler) return 1.0;
  return aims_at_poses(settings) ? 0.0 : kNumerov;
}

SpringWeights spring_weights(double resolved, double kappa) {
  if (resolved == 1.0) return {1.0, 0.0};
  const double square = kappa * kappa;
  const double sigma = square < 1e12 ? square / (square + 4.0) : 1.0;
  const double sum = 2.0 * resolved + (1.0 - 2.0 * resolved) * sigma;
  if (resolved == 0.0 && kappa < kResolved) return {0.0, 0.0};
  return {0.5 * (sum + sigma), 0.5 * (sum - sigma)};
}

void set_joint_springs(const Substep& sub, const State& state, Block& joint) {
  const double rate = drift_rate(drift_law(sub.settings), sub.settings.drift_tau, sub.dt);
  const double dt_previous = dt_previous_of(state, joint);
  const double force_time = impulse_time_of(sub, joint);
  const double dt_t = sub.dt * force_time;
  // At the start and after the probe, all of phi is elastic.
  const bool known = springs_are_stored(sub) && joint.seeded && dt_previous > 0.0;
  if (!known) std::copy_n(joint.phi, kMaxRows, joint.elastic);
  double speed[kMaxRows] = {};
  if (averages_springs(sub.settings)) row_speeds(joint, sub.u_start, speed);
  const auto set_rows = [&](int first, int end) {  // rows with a common compliance
    const double C = joint.C[first];
    for (int row = first; row < end; ++row) joint.spring_ahead[row] = joint.given[row] = 0.0;
    if (!(C > 0.0)) return;
    const SpringWeights w = spring_weights(resolved_weight(sub.settings),
                                           spring_kappa(dt_t, sub.inverse_mass, joint, first, end));
    for (int row = first; row < end; ++row) {
      const double elastic = joint.elastic[row];
      if (w.ahead == 0.0) {
        give_force(sub.inverse_mass, joint, row, -force_time * elastic / C, speed[row]);
        continue;
      }
      const double behind = w.behind * dt_previous * speed[row];
      joint.bias[row] = rate * (joint.phi[row] - elastic) + (elastic - behind) / (w.ahead * sub.dt);
      joint.softness[row] = C / (w.ahead * dt_t) + sub.scene->regularisation;
      joint.spring_ahead[row] = w.ahead;
      joint.spring_rest[row] = (1.0 - w.ahead) * elastic - behind;
    }
  };
  set_rows(0, joint.position_rows);
  set_rows(joint.position_rows, joint.rows);
}

// The mean force of the three poses under the full drift law, where all of phi is elastic. The
// solver determines whether the contact pushes, so forces are never prescribed. An open contact at
// the pose behind exerts no tension: otherwise an impact would gain energy. If the contact opens
// ahead, the mean is truncated and slightly dissipative.
void set_contact_spring(const Substep& sub, const State& state, Block& contact) {
  const double dt_previous = dt_previous_of(state, contact);
  const double force_time = impulse_time_of(sub, contact);
  const double kappa = spring_kappa(sub.dt * force_time, sub.inverse_mass, contact, 0, 1);
  if (!(kappa < kResolvedContact)) return;
  const SpringWeights w = solved_weights(sub.settings, kappa);
  double speed[kMaxRows];
  row_speeds(contact, sub.u_start, speed);
  const double ahead = w.ahead * sub.dt;
  const double phi = contact.phi[0];
  const double pressed = std::min(phi, 0.0);
  const double pressed_behind = std::min(phi - dt_previous * speed[0], 0.0);
  contact.bias[0] =
      (w.ahead * phi + (1.0 - w.ahead - w.behind) * pressed + w.behind * pressed_behind) / ahead;
  contact.softness[0] = contact.C[0] / (ahead * force_time) + sub.scene->regularisation;
  contact.spring_ahead[0] = w.ahead;
}

}  // namespace

bool averages_springs(const Settings& settings) { return resolved_weight(settings) < 1.0; }

SpringWeights solved_weights(const Settings& settings, double kappa) {
  const SpringWeights w = spring_weights(resolved_weight(settings), kappa);
  return w.ahead == 0.0 ? spring_weights(kNumerov, kappa) : w;  // leapfrog's
}

void set_springs(const Substep& sub, const State& state) {
  const bool averages = averages_springs(sub.settings);  // else plain Eq. 3
  const bool of_joints = sub.has_springs && (averages || springs_are_stored(sub));
  const bool of_contacts =
      averages && is_soft(sub.scene->contact) && drift_law(sub.settings) != Drift::kSoft;
  if (!of_joints && !of_contacts) return;
  for (Block& block : sub.rows) {
    if (block.is_contact()) {
      if (of_contacts) set_contact_spring(sub, state, block);
    } else if (of_joints && !block.is_bounded() && !is_grab(block)) {
      set_joint_springs(sub, state, block);
    }
  }
}

void store_elastic(Block& joint) {
  for (int row = 0; row < joint.rows; ++row) {
    joint.elastic[row] =
        joint.spring_ahead[row] > 0.0
            ? -(joint.C[row] * joint.lambda[row] + joint.spring_rest[row]) / joint.spring_ahead[row]
            : 0.0;
  }
}

}  // namespace substep
