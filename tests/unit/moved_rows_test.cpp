// Rows moved along with a sub-step against the same rows recomputed at its end.

#include "core/constraints/moved_rows.hpp"

#include "core/math/across.hpp"
#include "core/math/turn.hpp"
#include "core/stepping/integrate.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

TEST(Turn, EqualsTheRotationOfTheQuaternion) {
  Random random(31);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 c = 0.7 * random_vector(random);
    const Vec3 d = 0.7 * random_vector(random);
    const Vec3 v = random_vector(random);
    const auto quaternion = [](const Vec3& half) {
      return Quat(1.0, half.x(), half.y(), half.z()).normalized();
    };
    EXPECT_LT((turn_matrix(c) * v - quaternion(c) * v).norm(), 1e-14);
    EXPECT_LT((turn_matrix(turn_after(c, d)) * v - quaternion(d) * (quaternion(c) * v)).norm(),
              1e-12);
  }
}

/// Largest differences between moved rows and recomputed rows.
struct RowDifference {
  double phi = 0.0;
  double J = 0.0;
};

RowDifference after(const Scene& scene, State state, const Rows& rows, double dt) {
  Blocks start;
  rows(state, start);
  const std::vector<Vec6> u = state.u;
  integrate(whole(scene), dt, u, state);
  Blocks end;
  rows(state, end);
  RowDifference difference;
  EXPECT_EQ(start.size(), end.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Block& from = start.all()[i];
    const Block& expected = end.all()[i];
    EXPECT_EQ(from.id, expected.id);
    Block block = from;
    const auto of = [&](int body) {
      return body < 0 ? Motion{} : motion(u[static_cast<std::size_t>(body)], dt);
    };
    move_rows(from, of(from.a), of(from.b), block);
    double errors[kMaxRows];
    if (!from.is_contact()) moved_errors(from, of(from.a), of(from.b), errors);
    for (int row = 0; row < block.rows; ++row) {
      EXPECT_TRUE(from.is_contact() || errors[row] == block.phi[row]);
      const double change = expected.phi[row] - from.phi[row];
      keep_largest(difference.phi, std::abs(block.phi[row] - change));
      for (const bool a : {true, false}) {
        if ((a ? block.a : block.b) < 0) continue;
        const Vec6 J = gradient(block, row, a) - gradient(expected, row, a);
        keep_largest(difference.J, J.cwiseAbs().maxCoeff());
      }
    }
  }
  return difference;
}

void move_at_random(Random& random, const Scene& scene, State& state) {
  for (std::size_t i = 0; i < state.u.size(); ++i) {
    if (!scene.bodies[i].is_static) state.u[i] << random_vector(random), random_vector(random);
  }
}

Body somewhere(Random& random, Body body) {
  body.position = random_vector(random);
  body.orientation = random_rotation(random);
  return body;
}

TEST(MovedRows, OfJointsMatchThoseOfTheEnd) {
  Random random(32);
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene;
    scene.effects.joints = true;
    for (int i = 0; i < 2; ++i) {
      Body body = somewhere(random, moving(Box{Vec3{0.3, 0.2, 0.5}}, 2.0));
      body.is_static = i == 1 && trial % 4 == 1;
      scene.bodies.push_back(body);
    }
    HingeJoint hinge;
    hinge.a = 0;
    hinge.b = trial % 4 == 0 ? kWorld : 1;
    hinge.anchor_a = random_vector(random);
    hinge.anchor_b = random_vector(random);
    hinge.axis_a = random_vector(random).normalized();
    hinge.axis_b = random_vector(random).normalized();
    BallJoint ball;
    static_cast<JointBase&>(ball) = hinge;
    PrismaticJoint slider;
    static_cast<JointBase&>(slider) = hinge;
    Vec3 third;
    across(slider.axis_a = hinge.axis_a, slider.across_a, third);
    across(slider.axis_b = hinge.axis_b, slider.across_b, third);
    WeldJoint weld;
    static_cast<JointBase&>(weld) = hinge;
    weld.axis_a = slider.axis_a;
    weld.axis_b = slider.axis_b;
    weld.across_a = slider.across_a;
    weld.across_b = slider.across_b;
    DistanceJoint rod;
    static_cast<JointBase&>(rod) = hinge;
    UniversalJoint cross;
    static_cast<JointBase&>(cross) = hinge;
    CylindricalJoint cylinder;
    static_cast<JointBase&>(cylinder) = hinge;
    cross.axis_a = cylinder.axis_a = hinge.axis_a;
    cross.axis_b = cylinder.axis_b = hinge.axis_b;
    scene.joints = {hinge, ball, slider, weld, rod, cross, cylinder};
    State state = initial_state(scene);
    move_at_random(random, scene, state);
    const RowDifference difference = after(scene, state, joint_rows(scene), 0.5);
    EXPECT_LT(difference.phi, 1e-13);
    EXPECT_LT(difference.J, 1e-13);
  }
}

TEST(MovedRows, ASubsetOfRowsMatchesAllRows) {
  Random random(36);
  constexpr int kRows[] = {3, 5, 5, 6, 1, 4, 4, 0, 3};
  constexpr bool kPoints[] = {true, true, false, true, false, true, false, false, false};
  const std::vector<RowRange> parts[] = {{{0, 3}},
                                         {{0, 3}, {3, 2}},
                                         {{0, 2}, {2, 3}},
                                         {{0, 3}, {3, 3}},
                                         {{0, 1}},
                                         {{0, 3}, {3, 1}},
                                         {{0, 2}, {2, 2}},
                                         {},
                                         {{0, 1}, {1, 1}, {2, 1}}};
  static_assert(std::size(kRows) == kJointKinds + 1);
  for (int trial = 0; trial < 60; ++trial) {
    Block start{};
    const std::size_t kind = index(trial) % std::size(kRows);
    start.kind = kind == kJointKinds ? BlockKind::kContact : static_cast<BlockKind>(kind);
    start.has_point_rows = kPoints[kind];
    start.rows = kRows[kind];
    for (Vec3* v : {&start.n, &start.t1, &start.t2, &start.rho, &start.r_a, &start.r_b,
                    &start.arm_a, &start.axis, &start.v1, &start.v2, &start.w}) {
      *v = random_vector(random).normalized();
    }
    start.H = random_vector(random) * random_vector(random).transpose();
    const Motion a{random_vector(random), turn_matrix(random_vector(random))};
    const Motion b{random_vector(random), turn_matrix(random_vector(random))};
    Block all = start;
    move_rows(start, a, b, all);
    if (start.is_contact()) {
      EXPECT_EQ(moved_gap(start, a, b), all.phi[0]) << trial;
    }
    Block some = start;
    move_rows(start, b, a, some);  // first move to another pose
    for (const RowRange& rows : parts[kind]) {
      move_rows(start, a, b, some, rows);
      for (int row = rows.first; row < rows.first + rows.count; ++row) {
        EXPECT_EQ(some.phi[row], all.phi[row]) << trial << ", " << row;
        EXPECT_EQ(gradient(some, row, true), gradient(all, row, true)) << trial << ", " << row;
        EXPECT_EQ(gradient(some, row, false), gradient(all, row, false)) << trial << ", " << row;
      }
    }
  }
}

Scene touching(const Body& a, const Body& b, bool friction) {
  Scene scene;
  scene.effects.contact = true;
  scene.effects.friction = friction;
  scene.contact.margin = 5.0;
  scene.bodies = {a, b};
  return scene;
}

TEST(MovedRows, OfPointsOnFacesMatchThoseOfTheEnd) {
  Random random(33);
  for (int trial = 0; trial < 40; ++trial) {
    const Shape shape = trial % 2 == 0 ? Shape(Sphere{0.4}) : Shape(Box{Vec3{0.3, 0.2, 0.5}});
    const Scene scene =
        touching(somewhere(random, moving(shape)), somewhere(random, fixed(Plane{})), false);
    State state = initial_state(scene);
    move_at_random(random, scene, state);
    const RowDifference difference = after(scene, state, contact_rows(scene), 0.3);
    EXPECT_LT(difference.phi, 1e-13);
    EXPECT_LT(difference.J, 1e-13);
  }
}

// Halving the time reduces the neglected terms by a factor of eight, in J by four.
TEST(MovedRows, OfSpheresAreOfSecondOrder) {
  Random random(34);
  for (int trial = 0; trial < 20; ++trial) {
    Body a = somewhere(random, moving(Sphere{0.4}));
    Body b = somewhere(random, moving(Sphere{0.3}));
    b.position = a.position + random_vector(random).normalized();
    const Scene scene = touching(a, b, false);
    State state = initial_state(scene);
    move_at_random(random, scene, state);
    const RowDifference whole = after(scene, state, contact_rows(scene), 2e-3);
    const RowDifference half = after(scene, state, contact_rows(scene), 1e-3);
    EXPECT_GT(whole.phi / half.phi, 7.5);
    EXPECT_GT(whole.J / half.J, 3.4);  // of the largest entry, which may change
  }
}

// Friction measures the sliding distance of the point that touches: it turns with a corner, and
// stays under the centre of a ball that rolls.
TEST(MovedRows, OfFrictionMeasureTheSlidingDistance) {
  Random random(35);
  for (int trial = 0; trial < 20; ++trial) {
    const Shape shape = trial % 2 == 0 ? Shape(Box{Vec3{0.3, 0.2, 0.5}}) : Shape(Sphere{0.4});
    Scene scene =
        touching(somewhere(random, moving(shape)), somewhere(random, fixed(Plane{})), true);
    for (Body& body : scene.bodies) body.friction = 0.5;
    State state = initial_state(scene);
    move_at_random(random, scene, state);
    const FrictionStage friction(scene);
    Blocks blocks;
    contact_rows(scene)(state, blocks);
    friction.append(scene, rotations(state), blocks.all());
    const double dt = 0.2;
    State end = state;
    integrate(whole(scene), dt, state.u, end);
    for (const Block& start : blocks.all()) {
      Block block = start;
      ASSERT_EQ(start.a, 0);
      move_rows(start, motion(state.u[0], dt), Motion{}, block);
      const Vec3 turned = end.q[0] * (state.q[0].conjugate() * start.arm_a) - start.arm_a;
      const Vec3 rolled = dt * state.u[0].tail<3>().cross(start.r_a - start.arm_a);
      const Vec3 slid = (end.x[0] - state.x[0]) + turned + rolled;
      EXPECT_NEAR(block.phi[1], start.t1.dot(slid), 1e-13);
      EXPECT_NEAR(block.phi[2], start.t2.dot(slid), 1e-13);
      EXPECT_NEAR(block.t1.dot(block.n), 0.0, 1e-15);
      EXPECT_NEAR(block.t2.norm(), 1.0, 1e-15);
    }
  }
}

}  // namespace
}  // namespace substep::test
