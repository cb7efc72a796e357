#include "core/stepping/effective_mass.hpp"

#include "core/stepping/full_stiffness.hpp"

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
bool principal_mass(const Settings& s, const Vec3& I, const Vec6& k, double dt, Vec3& Mt) {
  StiffMass* const mass = entry_of(s.mode).mass;
  for (int j = 0; j < 3; ++j) Mt[j] = mass(s, I[j], k[3 + j], dt);
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

bool changes_mass_of(std::size_t body, const Scene& scene, const Settings& settings,
                     const State& state, double dt) {
  if (!changes_mass(settings.mode)) return false;
  if (entry_of(settings.mode).full_stiffness) {
    return body < state.K_resisting.size() && !state.K_resisting[body].isZero(0.0);
  }
  Vec3 Mt;
  return body < state.k.size() &&
         principal_mass(settings, scene.bodies[body].inertia, state.k[body], dt, Mt);
}

// S = Mt^-1 M converts u* computed with M to u* computed with Mt:
//   u* = beta u + (1 - beta) S u + Mt^-1 dt f = S (u_M - beta u) + beta u.
void effective_mass(const Scene& scene, const Part& part, const Settings& settings,
                    std::span<const InertiaInverse> own, std::span<const Mat3> R_WB,
                    std::span<const Vec6> u_start, double dt, State& state,
                    std::span<InverseMass> out) {
  const double beta = entry_of(settings.mode).beta.value_or(settings.beta);
  const bool stiffens = entry_of(settings.mode).full_stiffness;
  const std::size_t known = stiffens ? state.K_resisting.size() : state.k.size();
  for (const int body : part.moving) {
    const std::size_t i = index(body);
    const Vec3& I = scene.bodies[i].inertia;
    const Mat3& R = R_WB[i];
    Vec3 Mt;
    if (i >= known || (!stiffens && !principal_mass(settings, I, state.k[i], dt, Mt))) {
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
