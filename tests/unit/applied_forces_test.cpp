// The table of applied forces: every force against its own potential, and its bound.

#include "core/forces/applied_forces.hpp"

#include "core/stepping/substep.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

// The table asserts the concept for each force.
struct WithoutPotential : Gravity {
  static double potential() = delete;
};
struct WithoutEffect : Gravity {
  static constexpr int kEffect = 0;
};

TEST(AppliedForces, AForceWithoutAnOperationDoesNotCompile) {
  static_assert(AppliedForce<Gravity> && AppliedForce<ConstantForce>);
  static_assert(!AppliedForce<WithoutPotential>);
  static_assert(!AppliedForce<WithoutEffect>);
}

/// A moving box at random, with every applied force.
Scene forced(Random& random) {
  Scene scene;
  scene.gravity = 10.0 * random_vector(random);
  scene.bodies = {moving(Box{Vec3(0.3, 0.5, 0.7)}, uniform(random, 0.5, 20.0))};
  Body& body = scene.bodies[0];
  body.orientation = random_rotation(random);
  body.force = 30.0 * random_vector(random);
  body.torque = 5.0 * random_vector(random);
  for (const EffectEntry& effect : kEffects) scene.effects.*effect.member = true;
  return scene;
}

TEST(AppliedForces, AreTheGradientsOfTheirPotentials) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = forced(random);
    const Body& body = scene.bodies[0];
    const InertiaInverse own = inertia_inverses(scene)[0];
    const Mat3 R = body.orientation.toRotationMatrix();
    for_each_force(scene.effects, [&](auto force) {
      Vec6 u = Vec6::Zero();
      force.accelerate(scene, body, own, R, 2.0, u);
      const Vec3 x = random_vector(random);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = 1e-3 * Vec3::Unit(axis);
        const double slope =
            (force.potential(scene, body, x + step) - force.potential(scene, body, x - step)) /
            2e-3;
        EXPECT_NEAR(0.5 * body.mass * u[axis], -slope, 1e-9);
      }
    });
  }
}

TEST(AppliedForces, NoPointAcceleratesMoreThanTheBound) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Scene scene = forced(random);
    const Body& body = scene.bodies[0];
    const Mat3 R = body.orientation.toRotationMatrix();
    Vec6 a = Vec6::Zero();
    for_each_force(scene.effects, [&](auto force) {
      force.accelerate(scene, body, inertia_inverses(scene)[0], R, 1.0, a);
    });
    const double bound = acceleration_bound(scene, body);
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                      (corner & 4) != 0 ? 1 : -1);
      const Vec3 r = R * std::get<Box>(body.shape).half_extents.cwiseProduct(sign);
      keep_largest(largest, (a.head<3>() + a.tail<3>().cross(r)).norm());
    }
    EXPECT_LE(largest, bound);
    EXPECT_GT(largest, 0.02 * bound);
  }
}

TEST(AppliedForces, AnAbsentEffectDoesNothing) {
  Random random(5);
  Scene scene = forced(random);
  scene.effects = {.gravity = true, .external = true};
  EXPECT_TRUE(has_applied_forces(scene.effects));
  EXPECT_TRUE(has_applied_forces(scene.effects, {&Effects::gravity}));
  EXPECT_FALSE(has_applied_forces(scene.effects, {&Effects::gravity, &Effects::external}));
  scene.effects = {.joints = true, .contact = true};
  EXPECT_FALSE(has_applied_forces(scene.effects));
  EXPECT_EQ(acceleration_bound(scene, scene.bodies[0]), 0.0);
  scene.effects.gravity = true;
  EXPECT_EQ(acceleration_bound(scene, scene.bodies[0]), scene.gravity.norm());
  EXPECT_EQ(acceleration_bound(scene, fixed(Plane{})), 0.0);
}

}  // namespace
}  // namespace substep::test
