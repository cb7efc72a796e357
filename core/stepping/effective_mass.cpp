#include "core/stepping/effective_mass.hpp"

#include "core/stepping/damping.hpp"
#include "core/stepping/full_stiffness.hpp"
#include "core/stepping/geometric_inertia.hpp"
#include "core/stepping/mode_rules.hpp"

namespace substep {

namespace {

/// R diag(d) R^T, exactly symmetric.
inline void turn(const Mat3& R, const Vec3& d, Mat3& out) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = R.row(i).transpose().cwiseProduct(d);
    for (int j = 0; j <= i; ++j) {
      out(i, j) = out(j, i) = row.x() * R(j, 0) + row.y() * R(j, 1) + row.z() * R(j, 2);
    }
  }
}

inline void turn(const Mat3& R, const InertiaInverse& own, InverseMass& out) {
  out.linear = own.linear;
  if (own.isotropic) {
    out.angular = own.angular.asDiagonal();
  } else {
    turn(R, own.angular, out.angular);
  }
}

/// Mt about the principal axes of a body [kg m^2]. @return true if it differs from I
bool principal_mass(const Settings& s, StiffMass mass, const Vec3& I, const Vec6& k, double dt,
                    Vec3& Mt) {
  for (int j = 0; j < 3; ++j) {
    Mt[j] = mass == StiffMass::kDamped ? damped_mass(I[j], k[3 + j], s.alpha, dt)
                                       : stiffened_mass(I[j], k[3 + j], s.alpha_m, dt);
  }
  return Mt != I;
}

}  // namespace

std::vector<InertiaInverse> inertia_inverses(const Scene& scene) {
  std::vector<InertiaInverse> out(scene.bodies.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    const Vec3& I = body.inertia;
    out[i] = {1.0 / body.mass, I.cwiseInverse(), I[0] == I[1] && I[1] == I[2]};
  }
  return out;
}

void inverse_mass(std::span<const InertiaInverse> own, const Part& part, std::span<const Mat3> R_WB,
                  std::span<InverseMass> out) {
  for (const int body : part.moving) turn(R_WB[index(body)], own[index(body)], out[index(body)]);
}

bool changes_mass(Mode mode) { return rules_of(mode).mass != StiffMass::kOwn; }

bool changes_mass_of(std::size_t body, const Scene& scene, const Settings& settings,
                     const State& state, double dt) {
  const StiffMass mass = rules_of(settings.mode).mass;
  if (mass == StiffMass::kOwn) return false;
  if (mass == StiffMass::kFull) {
    return body < state.K_resisting.size() && !state.K_resisting[body].isZero(0.0);
  }
  Vec3 Mt;
  return body < state.k.size() &&
         principal_mass(settings, mass, scene.bodies[body].inertia, state.k[body], dt, Mt);
}

// S = Mt^-1 M converts u* computed with M to u* computed with Mt:
//   u* = beta u + (1 - beta) S u + Mt^-1 dt f = S (u_M - beta u) + beta u.
void effective_mass(const Scene& scene, const Part& part, const Settings& settings,
                    std::span<const InertiaInverse> own, std::span<const Mat3> R_WB,
                    std::span<const Vec6> u_start, double dt, State& state,
                    std::span<InverseMass> out) {
  const ModeRules rules = rules_of(settings.mode);
  const double beta = rules.beta.value_or(settings.beta);
  const bool stiffens = rules.mass == StiffMass::kFull;
  const std::size_t known = stiffens ? state.K_resisting.size() : state.k.size();
  for (const int body : part.moving) {
    const std::size_t i = index(body);
    const Vec3& I = scene.bodies[i].inertia;
    const Mat3& R = R_WB[i];
    Vec3 Mt;
    if (i >= known || (!stiffens && !principal_mass(settings, rules.mass, I, state.k[i], dt, Mt))) {
      turn(R, own[i], out[i]);
      continue;
    }
    out[i].linear = own[i].linear;
    auto omega = state.u[i].tail<3>();
    if (stiffens) {
      Mat3 M;
      turn(R, I, M);
      out[i].angular = fully_stiffened_mass(M, state.K_resisting[i], dt).inverse();
      omega = out[i].angular * (M * omega);
      continue;
    }
    const Vec3 W = Mt.cwiseInverse();
    turn(R, W, out[i].angular);
    const Vec3 kept = beta * u_start[i].tail<3>();
    const Vec3 rest_B = R.transpose() * (omega - kept);
    omega = kept + R * rest_B.cwiseProduct(I.cwiseProduct(W));
  }
}

}  // namespace substep
