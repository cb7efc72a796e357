#include "core/sim/conserved.hpp"

#include "core/forces/applied_forces.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"

namespace substep {

namespace {

/// Rate of the coordinate of a hinge or a slide, from the velocities at the time of the poses
/// [rad/s or m/s].
double rate_of(const Scene& scene, const State& state, const Joint& joint) {
  const JointBase& of = base(joint);
  const JointAxes axes = *axes_of(joint);
  const auto u = [&](int body) -> Vec6 {
    if (is_fixed(scene, body)) return Vec6::Zero();
    return state.u_synchronised[index(body)];
  };
  const auto turned = [&](int body, const Vec3& v) -> Vec3 {
    return body == kWorld ? v : Vec3(state.q[index(body)] * v);
  };
  const Vec6 u_a = u(of.a);
  const Vec6 u_b = u(of.b);
  if (!axes.slides) return turned(of.a, axes.a).dot(u_a.tail<3>() - u_b.tail<3>());
  const Vec3 r_a = turned(of.a, of.anchor_a);
  const Vec3 x_b = of.b == kWorld ? Vec3(Vec3::Zero()) : state.x[index(of.b)];
  const Vec3 r_b = state.x[index(of.a)] + r_a - x_b;
  const Vec3 v_a = u_a.head<3>() + Vec3(u_a.tail<3>()).cross(r_a);
  const Vec3 v_b = u_b.head<3>() + Vec3(u_b.tail<3>()).cross(r_b);
  return turned(of.b, axes.b).dot(v_a - v_b);
}

}  // namespace

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
  if (!scene.effects.joints || !scene.effects.armature) return sum;
  for (const Joint& joint : scene.joints) {
    const double armature = armature_of(joint);
    if (armature == 0.0) continue;
    const double rate = rate_of(scene, state, joint);
    sum.kinetic += 0.5 * armature * rate * rate;
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
