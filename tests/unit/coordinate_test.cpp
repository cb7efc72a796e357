#include <cmath>
#include <numbers>

#include "core/constraints/coordinate_stage.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/math/across.hpp"
#include "core/math/angle.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

TEST(Angle, EqualsThatOfTheLibrary) {
  Random random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    const double s = uniform(random);
    const double c = uniform(random) * (trial % 3 == 0 ? 1e-9 : 1.0);
    EXPECT_NEAR(angle_of(s, c), std::atan2(s, c), 1e-15 + 4e-16 * std::abs(std::atan2(s, c)));
  }
  for (const double small : {1e-300, 1e-12, 1e-5}) {
    EXPECT_NEAR(angle_of(small, 1.0) / small, 1.0, 1e-10);
  }
  EXPECT_EQ(angle_of(0.0, 1.0), 0.0);
  EXPECT_EQ(angle_of(0.0, 0.0), 0.0);
  EXPECT_NEAR(angle_of(0.0, -1.0), std::numbers::pi, 1e-15);
}

/// A hinge between two bodies that holds, at a random angle.
struct Turned {
  HingeJoint hinge;
  AngleLimit limit;
  Quat q[2];
  double angle = 0.0;

  explicit Turned(Random& random) {
    q[1] = random_rotation(random);
    angle = uniform(random, -3.0, 3.0);
    Vec3 third;
    hinge.axis_b = random_vector(random).normalized();
    across(hinge.axis_b, limit.across_b, third);
    const Vec3 axis = q[1] * hinge.axis_b;
    const Quat turn = Quat(Eigen::AngleAxisd(angle, axis)) * q[1];
    q[0] = turn * random_rotation(random);
    hinge.axis_a = q[0].conjugate() * axis;
    limit.across_a = q[0].conjugate() * (turn * limit.across_b);
    limit.lower = angle - uniform(random, 0.1, 1.0);
    limit.upper = angle + uniform(random, 0.1, 1.0);
  }

  /// @param by rotations of both bodies
  [[nodiscard]] Block row(bool upper, const Quat& by_a = Quat::Identity(),
                          const Quat& by_b = Quat::Identity()) const {
    Block block;
    block.a = 0;
    block.b = 1;
    block.kind = kind_of_coordinate<HingeAngle>();
    HingeAngle::constants(block);
    const Vec3 x = Vec3::Zero();
    const Mat3 R_a = (by_a * q[0]).toRotationMatrix();
    const Mat3 R_b = (by_b * q[1]).toRotationMatrix();
    HingeAngle::rows(HingeAngle::geometry(hinge, limit, upper), {x, R_a}, {x, R_b}, block);
    return block;
  }
};

Quat turn_by(double angle, int axis) { return Quat(Eigen::AngleAxisd(angle, Vec3::Unit(axis))); }

TEST(HingeAngle, MeasuresTheDistanceFromBothBounds) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Turned turned(random);
    EXPECT_NEAR(turned.row(false).phi[0], turned.angle - turned.limit.lower, 1e-14);
    EXPECT_NEAR(turned.row(true).phi[0], turned.limit.upper - turned.angle, 1e-14);
  }
}

// The distance from each bound is correct in a range of almost a full turn.
TEST(HingeAngle, DoesNotConfuseTheBoundsOfAWideRange) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Turned turned(random);
    turned.limit.lower = turned.angle - 0.02;
    turned.limit.upper = turned.limit.lower + 6.2;
    EXPECT_NEAR(turned.row(false).phi[0], 0.02, 1e-13);
    EXPECT_NEAR(turned.row(true).phi[0], 6.18, 1e-13);
  }
}

TEST(HingeAngle, GradientMatchesFiniteDifferences) {
  Random random(4);
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Turned turned(random);
    for (const bool upper : {false, true}) {
      const Block block = turned.row(upper);
      for (int axis = 0; axis < 3; ++axis) {
        const Quat forth = turn_by(kStep, axis);
        const Quat back = turn_by(-kStep, axis);
        const Quat none = Quat::Identity();
        const double by_a =
            turned.row(upper, forth, none).phi[0] - turned.row(upper, back, none).phi[0];
        const double by_b =
            turned.row(upper, none, forth).phi[0] - turned.row(upper, none, back).phi[0];
        EXPECT_NEAR(gradient(block, 0, true)[3 + axis], by_a / (2.0 * kStep), 1e-9);
        EXPECT_NEAR(gradient(block, 0, false)[3 + axis], by_b / (2.0 * kStep), 1e-9);
      }
    }
  }
}

// The torque rotates with a, and in the mean of both orders with the mean of both bodies.
TEST(HingeAngle, StiffnessMatchesFiniteDifferences) {
  Random random(5);
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Turned turned(random);
    Block block = turned.row(false);
    block.lambda[0] = uniform(random, 0.5, 2.0);
    StiffnessMatrix K;
    StiffnessMatrix mean;
    for (StiffnessMatrix* of : {&K, &mean}) of->clear(2);
    HingeAngle::stiffness(block, K);
    HingeAngle::mean_stiffness(block, mean);
    for (int axis = 0; axis < 3; ++axis) {
      const auto torque = [&](double by, bool of_a) -> Vec3 {
        const Quat turn = turn_by(by, axis);
        return block.lambda[0] * (of_a ? Vec3(turn * block.axis) : block.axis);
      };
      const Vec3 by_a = (torque(kStep, true) - torque(-kStep, true)) / (2.0 * kStep);
      EXPECT_LT((K.block(0, 0).col(3 + axis).tail<3>() - by_a).norm(), 1e-9);
      EXPECT_LT((K.block(1, 0).col(3 + axis).tail<3>() + by_a).norm(), 1e-9);
      EXPECT_EQ(K.block(0, 1).norm() + K.block(1, 1).norm(), 0.0);
      for (const int by : {0, 1}) {
        EXPECT_LT((mean.block(0, by).col(3 + axis).tail<3>() - 0.5 * by_a).norm(), 1e-9);
        EXPECT_LT((mean.block(1, by).col(3 + axis).tail<3>() + 0.5 * by_a).norm(), 1e-9);
      }
    }
  }
}

TEST(HingeAngle, MovedRowsAreTheRowsOfMovedBodies) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Turned turned(random);
    // A rotation of both, and one of a about the axis.
    const Quat both = random_rotation(random);
    const Quat alone(Eigen::AngleAxisd(uniform(random), turned.q[1] * turned.hinge.axis_b));
    const Block start = turned.row(true);
    const Block expected = turned.row(true, both * alone, both);
    Motion a;
    Motion b;
    a.R = (both * alone).toRotationMatrix();
    b.R = both.toRotationMatrix();
    Block moved = start;
    move_rows(start, a, b, moved);
    EXPECT_NEAR(moved.phi[0], expected.phi[0] - start.phi[0], 1e-13);
    double gained[kMaxRows];
    moved_errors(start, a, b, gained);
    EXPECT_EQ(gained[0], moved.phi[0]);
    for (const bool of_a : {true, false}) {
      EXPECT_LT((gradient(moved, 0, of_a) - gradient(expected, 0, of_a)).norm(), 1e-13);
    }
    const double force[] = {2.0};
    Vec6 on_a = Vec6::Zero();
    Vec6 on_b = Vec6::Zero();
    HingeAngle::push_change(start, a, b, force, on_a, on_b);
    EXPECT_LT((on_a - 2.0 * (gradient(moved, 0, true) - gradient(start, 0, true))).norm(), 1e-13);
    EXPECT_LT((on_b - 2.0 * (gradient(moved, 0, false) - gradient(start, 0, false))).norm(), 1e-13);
  }
}

TEST(HingeAngle, CurvatureMatchesFiniteDifferencesWhereTheHingeHolds) {
  Random random(7);
  constexpr double t = 1e-4;
  for (int trial = 0; trial < 20; ++trial) {
    const Turned turned(random);
    Vec6 u_a = Vec6::Zero();
    Vec6 u_b = Vec6::Zero();
    const Vec3 omega_b = random_vector(random);
    const Vec3 axis = turned.q[1] * turned.hinge.axis_b;
    u_b.tail<3>() = omega_b;
    u_a.tail<3>() = omega_b + uniform(random) * axis;
    const auto at = [&](double s) {
      const auto turn = [&](const Vec6& u) {
        const Vec3 omega = u.tail<3>();
        return Quat(Eigen::AngleAxisd(s * omega.norm(), omega.normalized()));
      };
      return turned.row(false, turn(u_a), turn(u_b)).phi[0];
    };
    double found[kMaxRows];
    HingeAngle::curvature(turned.row(false), u_a, u_b, found);
    EXPECT_NEAR(found[0], (at(t) - 2.0 * at(0.0) + at(-t)) / (t * t), 1e-6);
  }
}

/// A slide between two bodies that holds, at a random travel.
struct Slid {
  PrismaticJoint slide;
  Vec3 x[2];
  Quat q[2];

  explicit Slid(Random& random) {
    for (int i = 0; i < 2; ++i) {
      x[i] = random_vector(random);
      q[i] = random_rotation(random);
    }
    slide.axis_b = random_vector(random).normalized();
    slide.anchor_b = random_vector(random);
    const Vec3 at = x[1] + q[1] * (slide.anchor_b + uniform(random) * slide.axis_b);
    slide.anchor_a = q[0].conjugate() * (at - x[0]);
    slide.limit = TravelLimit{{-2.0, 1.5, 0.0}};
  }

  [[nodiscard]] Block row(bool upper, const Vec3 (&at)[2], const Quat (&turned)[2]) const {
    Block block;
    block.a = 0;
    block.b = 1;
    block.kind = kind_of_coordinate<SlideTravel>();
    SlideTravel::constants(block);
    const Mat3 R_a = turned[0].toRotationMatrix();
    const Mat3 R_b = turned[1].toRotationMatrix();
    SlideTravel::rows(SlideTravel::geometry(slide, *slide.limit, upper), {at[0], R_a}, {at[1], R_b},
                      block);
    return block;
  }
  [[nodiscard]] Block row(bool upper) const { return row(upper, x, q); }
  /// One degree of freedom of a body moved.
  [[nodiscard]] Block row(bool upper, int body, int dof, double by) const {
    Vec3 at[2] = {x[0], x[1]};
    Quat turned[2] = {q[0], q[1]};
    if (dof < 3) {
      at[body][dof] += by;
    } else {
      turned[body] = turn_by(by, dof - 3) * q[body];
    }
    return row(upper, at, turned);
  }
};

TEST(SlideTravel, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(8);
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Slid slid(random);
    for (const bool upper : {false, true}) {
      Block block = slid.row(upper);
      block.lambda[0] = uniform(random, 0.5, 2.0);
      StiffnessMatrix K;
      K.clear(2);
      SlideTravel::stiffness(block, K);
      for (const int body : {0, 1}) {
        for (int dof = 0; dof < 6; ++dof) {
          const Block forth = slid.row(upper, body, dof, kStep);
          const Block back = slid.row(upper, body, dof, -kStep);
          EXPECT_NEAR(gradient(block, 0, body == 0)[dof],
                      (forth.phi[0] - back.phi[0]) / (2.0 * kStep), 1e-9);
          for (const int on : {0, 1}) {
            const Vec6 change = block.lambda[0] / (2.0 * kStep) *
                                (gradient(forth, 0, on == 0) - gradient(back, 0, on == 0));
            EXPECT_LT((K.block(on, body).col(dof) - change).norm(), 1e-8);
          }
        }
      }
    }
    EXPECT_NEAR(slid.row(false).phi[0] + slid.row(true).phi[0], 3.5, 1e-12);
  }
}

/// A rope between two bodies at random poses.
struct Roped {
  RopeJoint rope;
  Vec3 x[2];
  Quat q[2];

  explicit Roped(Random& random) {
    for (int i = 0; i < 2; ++i) {
      x[i] = random_vector(random);
      q[i] = random_rotation(random);
    }
    rope.anchor_a = random_vector(random);
    rope.anchor_b = random_vector(random);
    rope.limit->upper = uniform(random, 0.5, 2.0);
  }

  /// @param by a displacement and rotation of each body
  [[nodiscard]] Block row(const Vec6& by_a = Vec6::Zero(), const Vec6& by_b = Vec6::Zero()) const {
    const auto turn = [](const Vec6& by) -> Quat {
      const Vec3 angle = by.tail<3>();
      return angle.isZero(0.0) ? Quat(Quat::Identity())
                               : Quat(Eigen::AngleAxisd(angle.norm(), angle.normalized()));
    };
    Block block;
    block.a = 0;
    block.b = 1;
    block.kind = kind_of_coordinate<RopeLength>();
    RopeLength::constants(block);
    const Vec3 x_a = x[0] + by_a.head<3>();
    const Vec3 x_b = x[1] + by_b.head<3>();
    const Mat3 R_a = (turn(by_a) * q[0]).toRotationMatrix();
    const Mat3 R_b = (turn(by_b) * q[1]).toRotationMatrix();
    RopeLength::rows(RopeLength::geometry(rope, *rope.limit, true), {x_a, R_a}, {x_b, R_b}, block);
    return block;
  }
};

TEST(RopeLength, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(9);
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Roped roped(random);
    Block block = roped.row();
    const Vec3 apart = roped.x[0] + roped.q[0] * roped.rope.anchor_a - roped.x[1] -
                       roped.q[1] * roped.rope.anchor_b;
    EXPECT_NEAR(block.phi[0], roped.rope.limit->upper - apart.norm(), 1e-14);
    block.lambda[0] = uniform(random, 0.5, 2.0);
    StiffnessMatrix K;
    K.clear(2);
    RopeLength::stiffness(block, K);
    for (const int body : {0, 1}) {
      for (int dof = 0; dof < 6; ++dof) {
        const Vec6 by = kStep * Vec6::Unit(dof);
        const Vec6 none = Vec6::Zero();
        const Block forth = body == 0 ? roped.row(by) : roped.row(none, by);
        const Block back = body == 0 ? roped.row(-by) : roped.row(none, -by);
        EXPECT_NEAR(gradient(block, 0, body == 0)[dof],
                    (forth.phi[0] - back.phi[0]) / (2.0 * kStep), 1e-8);
        for (const int on : {0, 1}) {
          const Vec6 change = block.lambda[0] / (2.0 * kStep) *
                              (gradient(forth, 0, on == 0) - gradient(back, 0, on == 0));
          EXPECT_LT((K.block(on, body).col(dof) - change).norm(), 1e-7);
        }
      }
    }
  }
}

TEST(RopeLength, CurvatureAndMovedRowsMatchThoseOfTheEnd) {
  Random random(10);
  for (int trial = 0; trial < 20; ++trial) {
    const Roped roped(random);
    Vec6 u_a;
    Vec6 u_b;
    u_a << random_vector(random), random_vector(random);
    u_b << random_vector(random), random_vector(random);
    const double t = 1e-4;
    const Block now = roped.row();
    double found[kMaxRows];
    RopeLength::curvature(now, u_a, u_b, found);
    const double second = roped.row(t * u_a, t * u_b).phi[0] - 2.0 * now.phi[0] +
                          roped.row(-t * u_a, -t * u_b).phi[0];
    EXPECT_NEAR(found[0], second / (t * t), 1e-5 * (1.0 + std::abs(found[0])));

    const Block end = roped.row(u_a, u_b);
    const auto motion_of = [](const Vec6& u) -> Motion {
      const Vec3 angle = u.tail<3>();
      return {u.head<3>(), Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix()};
    };
    Block moved = now;
    RopeLength::move(now, motion_of(u_a), motion_of(u_b), {}, moved);
    EXPECT_NEAR(moved.phi[0], end.phi[0] - now.phi[0], 1e-13);
    const double force[1] = {1.7};
    Vec6 change[2] = {Vec6::Zero(), Vec6::Zero()};
    RopeLength::push_change(now, motion_of(u_a), motion_of(u_b), force, change[0], change[1]);
    for (const bool of_a : {true, false}) {
      EXPECT_LT((gradient(moved, 0, of_a) - gradient(end, 0, of_a)).norm(), 1e-13);
      const Vec6 expected = force[0] * (gradient(end, 0, of_a) - gradient(now, 0, of_a));
      EXPECT_LT((change[of_a ? 0 : 1] - expected).norm(), 1e-12);
    }
    EXPECT_EQ(RopeLength::force(now, force), force[0] * now.n);
  }
}

TEST(CoordinateStage, IdsAreThoseOfNoJointContactOrGrab) {
  Scene scene;
  scene.effects.joints = scene.effects.limits = scene.effects.motors = true;
  scene.effects.drives = scene.effects.joint_friction = scene.effects.armature = true;
  scene.effects.springs = true;
  scene.bodies = {moving(Sphere{0.1}), moving(Sphere{0.1})};
  HingeJoint hinge;
  hinge.b = 1;
  hinge.limit = AngleLimit{{-1.0, 1e-4, 0.0}, {}};
  hinge.motor = AngularMotor{{1.0, 2.0}};
  hinge.drive = AngularDrive{{.stiffness = 3.0}, {}};
  hinge.friction = 4.0;
  hinge.armature = 5.0;
  hinge.spring = AngularSpring{{.rest = 6.0, .stiffness = 7.0, .damping = 8.0}, {}};
  scene.joints = {BallJoint{}, hinge};
  CoordinateStage stage(scene);
  EXPECT_EQ(stage.size(), 7U);
  Blocks blocks;
  const State state = initial_state(scene);
  stage.append(whole(scene), state, rotations(state), 0.01, true, blocks);
  ASSERT_EQ(blocks.size(), 6U)
      << "the upper bound, which is closed, motor, drive, friction, armature and spring";
  for (const Block& block : blocks.all()) {
    EXPECT_TRUE(CoordinateStage::is_id(block.id));
    EXPECT_FALSE(is_contact_id(block.id));
    EXPECT_EQ(CoordinateStage::joint_of(block.id), 1);
    EXPECT_TRUE(block.is_bounded());
    EXPECT_EQ(block.armature, 5.0);
  }
  EXPECT_TRUE(blocks.all()[0].is_unilateral());
  EXPECT_TRUE(blocks.all()[1].is_motor());
  EXPECT_EQ(stage.motor(blocks.all()[1]).effort, 2.0);
  EXPECT_FALSE(is_drive(blocks.all()[1]));
  EXPECT_TRUE(is_drive(blocks.all()[2]));
  EXPECT_EQ(stage.drive(blocks.all()[2]).stiffness, 3.0);
  EXPECT_TRUE(is_joint_friction(blocks.all()[3]));
  EXPECT_EQ(stage.friction(blocks.all()[3]), 4.0);
  EXPECT_TRUE(is_armature(blocks.all()[4]));
  EXPECT_FALSE(is_joint_spring(blocks.all()[2]));
  EXPECT_TRUE(is_joint_spring(blocks.all()[5]) && is_drive(blocks.all()[5]));
  EXPECT_EQ(stage.drive(blocks.all()[5]).target, 6.0);
  EXPECT_EQ(stage.drive(blocks.all()[5]).stiffness, 7.0);
  EXPECT_EQ(stage.drive(blocks.all()[5]).damping, 8.0);
  blocks.clear();
  stage.append(whole(scene), state, rotations(state), 0.01, false, blocks);
  EXPECT_EQ(blocks.size(), 6U) << "the lower bound is far";
}

}  // namespace
}  // namespace substep::test
