#include "core/sim/conserved.hpp"

#include "core/forces/applied_forces.hpp"
#include "core/model/validate.hpp"

namespace substep {

Energies energies_of(const Scene& scene, const State& state) {
  Energies sum;
  if (!fits(state, scene)) return sum;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    const Vec6& u = state.u_synchronised[i];
    const Vec3 omega_B = state.q[i].conjugate() * Vec3(u.tail<3>());
    sum.kinetic += 0.5 * body.mass * u.head<3>().squaredNorm() +
                   0.5 * omega_B.dot(body.inertia.cwiseProduct(omega_B));
    for_each_force(scene.effects,
                   [&](auto force) { sum.potential += force.potential(scene, body, state.x[i]); });
  }
  return sum;
}

Momenta momenta_of(const Scene& scene, const State& state) {
  Momenta sum;
  if (!fits(state, scene)) return sum;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    const Vec6& u = state.u_synchronised[i];
    const Vec3 p = body.mass * u.head<3>();
    const Vec3 omega_B = state.q[i].conjugate() * Vec3(u.tail<3>());
    sum.linear += p;
    sum.angular += state.x[i].cross(p) + state.q[i] * body.inertia.cwiseProduct(omega_B);
  }
  return sum;
}

}  // namespace substep
