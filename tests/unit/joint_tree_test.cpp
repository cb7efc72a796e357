// The exact motion of trees of hinges and ball joints in space.

#include "core/lab/joint_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/lab/planar_chain.hpp"
#include "core/math/hash.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/tree_scenes.hpp"

namespace substep::test {
namespace {

using Angle = Eigen::AngleAxisd;

double energy(const Scene& scene, const JointTree& tree) {
  return tree.kinetic() + potential(scene, tree);
}

/// Distance of two orientations as rotation matrices.
double apart(const Quat& a, const Quat& b) {
  return (a.toRotationMatrix() - b.toRotationMatrix()).norm();
}

// ------------------------------------------------------------------------------- closed forms
// I = (A, C, A): the axis turns about the angular momentum L at |L|/A, and the body about the axis
// at w (A - C)/A, w being the angular velocity along the axis.
TEST(JointTree, FreeSymmetricBodyPrecesses) {
  Scene scene = scenes::spinning_top();
  Body& body = scene.bodies[0];
  body.inertia = {0.3, 0.5, 0.3};
  body.angular_velocity = {1.5, 4.0, -0.8};
  const Vec3 omega = body.angular_velocity;
  const Vec3 L = body.inertia.cwiseProduct(omega);
  JointTree tree = tree_of(scene);
  EXPECT_EQ(tree.size(), 6);
  const double t = 7.0;
  tree.advance(t);
  const Quat expected = Quat(Angle(L.norm() / 0.3 * t, L.normalized())) *
                        Quat(Angle(omega.y() * (0.3 - 0.5) / 0.3 * t, Vec3::UnitY()));
  EXPECT_LT(apart(tree.orientation(0), expected), 1e-10);
  EXPECT_LT((tree.centre(0) - body.position).norm(), 1e-14);
}

// (C w - A W cos theta) W = m g l for a precession W about the vertical and w along the axis, with
// A about the tip.
TEST(JointTree, HeavySymmetricTopPrecessesSteadily) {
  Scene scene = scenes::heavy_top();
  Body& top = scene.bodies[0];
  const Vec3 tip = std::get<BallJoint>(scene.joints[0]).anchor_b;
  const Vec3 arm = top.position - tip;
  const double l = arm.norm();
  const double cosine = arm.y() / l;
  const double precession = 0.8;  // [rad/s]
  const double A = top.inertia.x() + top.mass * l * l;
  const double C = top.inertia.y();
  const double along = (top.mass * 9.81 * l / precession + A * precession * cosine) / C;
  const Vec3 turn = precession * Vec3::UnitY();
  top.angular_velocity = turn + (along - precession * cosine) * arm / l;
  top.velocity = turn.cross(arm);
  JointTree tree = tree_of(scene);
  EXPECT_EQ(tree.size(), 3);
  for (int second = 1; second <= 10; ++second) {
    tree.advance(1.0);
    const Vec3 expected = tip + Angle(precession * second, Vec3::UnitY()) * arm;
    EXPECT_LT((tree.centre(0) - expected).norm(), 1e-11) << second;
  }
}

// A published heavy top, spun fast and thrown into its precession: Euler parameters at 0.2 s, five
// digits. Its fixed point is the origin, gravity along -z.
TEST(JointTree, AgreesWithAPublishedHeavyTop) {
  Scene scene = scenes::heavy_top();
  scene.gravity = {0.0, 0.0, -9.81};
  Body& top = scene.bodies[0];
  top.mass = 15.0;
  top.inertia = {0.234375, 0.46875, 0.234375};
  top.position = {0.0, 1.0, 0.0};
  top.orientation = Quat::Identity();
  top.angular_velocity = {0.0, 150.0, -4.61538};
  top.velocity = top.angular_velocity.cross(top.position);
  auto& joint = std::get<BallJoint>(scene.joints[0]);
  joint.anchor_a = {0.0, -1.0, 0.0};
  joint.anchor_b = Vec3::Zero();
  JointTree tree = tree_of(scene);
  tree.advance(0.2);
  const Quat published(-0.70828, 0.43878, 0.54573, 0.0894);
  EXPECT_LT((tree.orientation(0).coeffs() - published.coeffs()).norm(), 5e-6);
}

TEST(JointTree, PendulumHasThePeriodOfTheEllipticIntegral) {
  Scene scene = scenes::pendulum();
  scene.effects.gyroscopic = true;
  const double about_pivot = scene.bodies[0].inertia.z() + 0.25;
  const double half_angle = std::sqrt((1.0 - 0.8) / 2.0);  // sin(theta_0/2) of cos(theta_0) = 0.8
  const double period =
      4.0 * std::sqrt(about_pivot / (9.81 * 0.5)) * std::comp_ellint_1(half_angle);
  JointTree tree = tree_of(scene);
  EXPECT_EQ(tree.size(), 1);
  const Vec3 start = tree.centre(0);
  tree.advance(0.5 * period);
  EXPECT_NEAR(tree.centre(0).x(), -start.x(), 1e-12);
  tree.advance(0.5 * period);
  EXPECT_LT((tree.centre(0) - start).norm(), 1e-12);
}

TEST(JointTree, AgreesWithThePlanarChainOnTheSwingingBox) {
  Scene scene = scenes::swinging_box();
  scene.effects.gyroscopic = true;  // no effect in planar motion
  JointTree tree = tree_of(scene);
  auto chain = PlanarChain::of(scene);
  ASSERT_TRUE(chain.has_value());
  EXPECT_EQ(tree.size(), 26);
  for (int frame = 0; frame < repetitions(300, 10); ++frame) {
    tree.advance(scene.frame);
    chain->advance(scene.frame);
    for (int i = 1; i <= 26; ++i) {
      ASSERT_LT((tree.centre(i) - chain->centre(i)).norm(), 1e-10) << frame << ' ' << i;
    }
  }
  EXPECT_NEAR(tree.kinetic(), chain->kinetic(), 1e-10 * chain->kinetic());
}

// -------------------------------------------------------------------------------- conservation
class Trees : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(JointTree, Trees,
                         testing::Values(scenes::spherical_pendulum(), scenes::heavy_top(),
                                         scenes::whirling_chain(), six_boxes(), branching_tree()),
                         [](const auto& scene) { return scene.param.name; });

TEST_P(Trees, EnergyAndVerticalAngularMomentumAreConservedForTenSeconds) {
  const Scene& scene = GetParam();
  JointTree tree = tree_of(scene);
  const Vec3 pivot = base(scene.joints[0]).anchor_b;
  const double before = energy(scene, tree);
  const double vertical = angular_momentum(scene, tree, pivot).y();
  double exchanged = tree.kinetic();
  double largest = angular_momentum(scene, tree, pivot).norm();
  for (int frame = 0; frame < repetitions(600, 60); ++frame) {
    tree.advance(1.0 / 60.0);
    keep_largest(exchanged, tree.kinetic());
    keep_largest(largest, angular_momentum(scene, tree, pivot).norm());
    ASSERT_NEAR(energy(scene, tree), before, 1e-9 * exchanged) << frame;
    ASSERT_NEAR(angular_momentum(scene, tree, pivot).y(), vertical, 1e-9 * largest) << frame;
  }
}

// Ten times the tolerance never gives a better answer, and each run is as accurate as stated.
TEST_P(Trees, ErrorFollowsTheTolerance) {
  const JointTree start = tree_of(GetParam());
  const int body = start.bodies() - 1;
  const auto centre_at = [&](double tolerance) {
    JointTree tree = start;
    tree.set_tolerance(tolerance);
    tree.advance(1.5);
    return tree.centre(body);
  };
  const Vec3 finest = centre_at(1e-13);
  EXPECT_LT((centre_at(1e-6) - finest).norm(), 1e-4);
  EXPECT_LT((centre_at(1e-9) - finest).norm(), 1e-8);
  EXPECT_LT((centre_at(1e-12) - finest).norm(), 1e-11);
}

// Newton's and Euler's equations of every body, from velocities alone: the forces of its own joint
// and of its children's joints change its momentum.
TEST_P(Trees, ReactionsEqualTheRatesOfMomentum) {
  const Scene& scene = GetParam();
  constexpr double kStep = 1e-4;  // [s]
  JointTree before = tree_of(scene);
  before.advance(0.4);
  JointTree now = before;
  now.advance(kStep);
  JointTree after = now;
  after.advance(kStep);
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& body = scene.bodies[index(i)];
    const auto momentum = [&](const JointTree& at) {
      const Mat3 R = at.orientation(i).toRotationMatrix();
      Vec6 p = at.velocity(i);
      p.head<3>() *= body.mass;
      p.tail<3>() = R * body.inertia.asDiagonal() * R.transpose() * p.tail<3>();
      return p;
    };
    Vec6 acting = now.reaction(i);
    acting.head<3>() += body.mass * scene.gravity;
    for (const Joint& joint : scene.joints) {
      // The tree's joints all have the child as a.
      if (base(joint).b != i) continue;
      const int child = base(joint).a;
      const Vec6 from = now.reaction(child);
      acting.head<3>() -= from.head<3>();
      const Vec3 arm = now.centre(child) - now.centre(i);
      acting.tail<3>() -= from.tail<3>() + arm.cross(Vec3(from.head<3>()));
    }
    const Vec6 rate = (momentum(after) - momentum(before)) / (2.0 * kStep);
    EXPECT_LT((rate - acting).norm(), 1e-4 * (1.0 + acting.norm())) << scene.name << ' ' << i;
  }
}

// A ball joint transmits no torque, a hinge none along its axis, about the joint's own point.
TEST(JointTree, FreeDirectionsOfJointsBearNoTorque) {
  const Scene scene = branching_tree();
  JointTree tree = tree_of(scene);
  tree.advance(0.7);
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    const Vec6 at_centre = tree.reaction(j.a);
    const Vec3 arm = tree.orientation(j.a) * j.anchor_a;
    const Vec3 torque = at_centre.tail<3>() - arm.cross(Vec3(at_centre.head<3>()));
    const auto* hinge = std::get_if<HingeJoint>(&joint);
    const double free = hinge ? torque.dot(tree.orientation(j.a) * hinge->axis_a) : torque.norm();
    EXPECT_NEAR(free, 0.0, 1e-10 * (1.0 + at_centre.norm())) << j.name;
  }
}

// Without support the centre of mass falls, and the angular momentum about it is conserved.
TEST(JointTree, FreeTreeKeepsItsMomenta) {
  const Scene scene = free_tree();
  JointTree tree = tree_of(scene);
  EXPECT_EQ(tree.size(), 6 + branching_degrees() - 3);
  const auto [mass, at, velocity] = centre_of_mass(scene);
  const Vec3 spin = angular_momentum(scene, tree, at);
  const double before = energy(scene, tree);
  double t = 0.0;
  for (int k = 0; k < 5; ++k) {
    tree.advance(0.5);
    t += 0.5;
    Vec3 now = Vec3::Zero();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      now += scene.bodies[i].mass / mass * tree.centre(static_cast<int>(i));
    }
    const Vec3 expected = at + t * velocity + 0.5 * t * t * scene.gravity;
    EXPECT_LT((now - expected).norm(), 1e-10) << t;
    // The angular momentum about the moving centre is the total minus the orbital part.
    const Vec3 orbital = mass * (now - at).cross(velocity + t * scene.gravity);
    const Vec3 own = angular_momentum(scene, tree, at) - orbital;
    EXPECT_LT((own - spin).norm(), 1e-9 * spin.norm()) << t;
    EXPECT_NEAR(energy(scene, tree), before, 1e-9 * tree.kinetic());
  }
}

// -------------------------------------------------------------------------------- invariance
TEST(JointTree, OrderOfBodiesAndSidesOfJointsDoNotMatter) {
  for (const Scene& scene : {branching_tree(), free_tree(), six_boxes()}) {
    const int n = static_cast<int>(scene.bodies.size());
    const JointTree expected = [&] {
      JointTree tree = tree_of(scene);
      tree.advance(1.0);
      return tree;
    }();
    for (unsigned seed = 1; seed <= static_cast<unsigned>(repetitions(3, 1)); ++seed) {
      std::vector<int> place;
      const Scene other = shuffled(scene, seed, place);
      JointTree tree = tree_of(other);
      tree.advance(1.0);
      for (int i = 0; i < n; ++i) {
        EXPECT_LT((tree.centre(place[index(i)]) - expected.centre(i)).norm(), 1e-10) << scene.name;
        EXPECT_LT(apart(tree.orientation(place[index(i)]), expected.orientation(i)), 1e-9);
      }
    }
  }
}

TEST(JointTree, StaticBodiesAreWorld) {
  const Scene scene = branching_tree();
  Scene held = scene;
  Body post;
  post.name = "post";
  post.is_static = true;
  post.position = {1.0, 2.0, 3.0};
  post.orientation = Quat(Angle(0.7, Vec3(1.0, -1.0, 2.0).normalized()));
  auto& joint = std::get<BallJoint>(held.joints[0]);
  joint.b = static_cast<int>(held.bodies.size());
  joint.anchor_b = post.orientation.conjugate() * (joint.anchor_b - post.position);
  held.bodies.push_back(post);
  JointTree a = tree_of(scene);
  JointTree b = tree_of(held);
  a.advance(1.0);
  b.advance(1.0);
  EXPECT_LT((a.centre(4) - b.centre(4)).norm(), 1e-10);
  EXPECT_EQ(b.centre(joint.b), post.position);
  EXPECT_EQ(b.velocity(joint.b), Vec6(Vec6::Zero()));
}

// The steps of MuJoCo, of first order: half the step, half the distance.
TEST(JointTree, SemiImplicitStepsConvergeToTheExactMotion) {
  for (const Scene& scene : {branching_tree(), free_tree()}) {
    JointTree exact = tree_of(scene);
    exact.advance(0.3);
    double before = 0.0;
    for (const int steps : {1000, 2000, 4000}) {
      JointTree tree = tree_of(scene);
      for (int i = 0; i < steps; ++i) tree.step_semi_implicit(0.3 / steps);
      double most = 0.0;
      for (int i = 0; i < tree.bodies(); ++i) {
        most = std::max(most, (tree.centre(i) - exact.centre(i)).norm());
      }
      EXPECT_LT(most, 0.1);
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / most), 1.0, 0.1) << scene.name;
      }
      before = most;
      EXPECT_NEAR(tree.potential(), potential(scene, tree), 1e-9 * (1.0 + tree.kinetic()));
    }
  }
}

// The code calls no function but sqrt. A change of the integrator changes these numbers.
TEST(JointTree, BitsAreTheSameWithEveryCompiler) {
  JointTree tree = tree_of(scenes::whirling_chain());
  tree.advance(1.0);
  Hash hash;
  for (int i = 0; i < tree.bodies(); ++i) {
    for (const double x : tree.centre(i)) hash.add(x);
    for (const double x : tree.velocity(i)) hash.add(x);
  }
  EXPECT_EQ(hash.value(), 0x9fef1ba41b621348ULL);
}

// The steps of one call end at the requested time; the motion is the same.
TEST(JointTree, AttemptsEqualOneAdvance) {
  JointTree whole = tree_of(scenes::whirling_chain());
  JointTree sliced = whole;
  whole.advance(0.5);
  double left = 0.5;
  int attempts = 0;
  for (; left > 1e-15; ++attempts) left -= sliced.attempt(left);
  EXPECT_GT(attempts, 3);
  EXPECT_EQ(sliced.centre(7), whole.centre(7));
}

}  // namespace
}  // namespace substep::test
