#include "core/constraints/moved_rows.hpp"
#include "core/math/across.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/types_in_files.hpp"
#include "core/solver/system.hpp"
#include "core/stepping/integrate.hpp"
#include "tests/support/dense_oracle.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// Two boxes at random poses with a random joint that has an error: the formulas also hold off the
/// constraint.
template <class JointType>
Scene joined(Random& random, bool to_world) {
  Scene scene;
  scene.effects.joints = true;
  for (int i = 0; i < (to_world ? 1 : 2); ++i) {
    Body body = moving(Box{Vec3{0.3, 0.2, 0.5}}, 2.0);
    body.position = random_vector(random);
    body.orientation = random_rotation(random);
    scene.bodies.push_back(body);
  }
  JointType joint;
  joint.a = 0;
  joint.b = to_world ? kWorld : 1;
  joint.anchor_a = random_vector(random);
  joint.anchor_b = random_vector(random);
  if constexpr (
      requires { joint.axis_a; } && !requires { joint.across_a; }) {
    joint.axis_a = random_vector(random).normalized();
    joint.axis_b = random_vector(random).normalized();
  }
  if constexpr (requires { joint.across_a; }) {
    across(joint.axis_a = random_vector(random).normalized(), joint.across_a, joint.axis_b);
    Vec3 third;
    across(joint.axis_b = random_vector(random).normalized(), joint.across_b, third);
  }
  if constexpr (requires { joint.length; }) joint.length = uniform(random, 0.5, 2.0);
  scene.joints.push_back(joint);
  return scene;
}

template <class JointType>
void gradient_and_stiffness() {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = joined<JointType>(random, trial % 4 == 0);
    const State state = initial_state(scene);
    const Rows rows = joint_rows(scene);
    expect_gradient(scene, state, rows);
    expect_stiffness(scene, state, rows, random);
  }
}

// A joint type without one of the operations is not a valid entry of JointTable: the table asserts
// the concept for each entry, so that it does not compile.
struct WithoutCurvature : BallRows {
  static void curvature() = delete;
};
struct WithoutCouple : HingeRows {
  static void torque(const Block&, const double*) {}
};

TEST(JointTable, AnEntryWithoutAnOperationDoesNotCompile) {
  static_assert(JointRows<BallRows, BallJoint>);
  static_assert(JointRows<HingeRows, HingeJoint>);
  static_assert(JointRows<PrismaticRows, PrismaticJoint>);
  static_assert(JointRows<WeldRows, WeldJoint>);
  static_assert(JointRows<DistanceRows, DistanceJoint>);
  static_assert(JointRows<UniversalRows, UniversalJoint>);
  static_assert(JointRows<CylindricalRows, CylindricalJoint>);
  static_assert(!JointRows<WithoutCurvature, BallJoint>);
  static_assert(!JointRows<WithoutCouple, HingeJoint>);
  EXPECT_EQ(kind_of(BallJoint{}), BlockKind{0});
  EXPECT_EQ(kind_of(HingeJoint{}), BlockKind{1});
  EXPECT_EQ(kind_of(PrismaticJoint{}), BlockKind{2});
  for (std::size_t type = 0; type < kTypes<Joint>.size(); ++type) {
    EXPECT_EQ(make_type<Joint>(type).index(), type);
  }
}

TEST(BallJoint, GradientAndStiffnessMatchFiniteDifferences) { gradient_and_stiffness<BallJoint>(); }
TEST(HingeJoint, GradientAndStiffnessMatchFiniteDifferences) {
  gradient_and_stiffness<HingeJoint>();
}
TEST(PrismaticJoint, GradientAndStiffnessMatchFiniteDifferences) {
  gradient_and_stiffness<PrismaticJoint>();
}
TEST(WeldJoint, GradientAndStiffnessMatchFiniteDifferences) { gradient_and_stiffness<WeldJoint>(); }
TEST(DistanceJoint, GradientAndStiffnessMatchFiniteDifferences) {
  gradient_and_stiffness<DistanceJoint>();
}

TEST(UniversalJoint, GradientAndStiffnessMatchFiniteDifferences) {
  gradient_and_stiffness<UniversalJoint>();
}
TEST(CylindricalJoint, GradientAndStiffnessMatchFiniteDifferences) {
  gradient_and_stiffness<CylindricalJoint>();
}

void close(CylindricalJoint& joint, const State& state) {
  const Quat turn = state.q[0].conjugate() * state.q[1];
  joint.axis_a = turn * joint.axis_b;
  joint.anchor_a = state.q[0].conjugate() * (state.x[1] - state.x[0]) +
                   turn * (joint.anchor_b + 0.7 * joint.axis_b);
}

void close(HingeJoint& joint, const State& state) {
  const Quat turn = state.q[0].conjugate() * state.q[1];
  joint.axis_a = turn * joint.axis_b;
  joint.anchor_a = state.q[0].conjugate() * (state.x[1] - state.x[0]) + turn * joint.anchor_b;
}

/// Closes a joint that fixes the orientation. @param travel of a slide [m]
void close(auto& joint, const State& state, double travel) {
  const Quat turn = state.q[0].conjugate() * state.q[1];
  joint.axis_a = turn * joint.axis_b;
  joint.across_a = turn * joint.across_b;
  joint.anchor_a = state.q[0].conjugate() * (state.x[1] - state.x[0]) +
                   turn * (joint.anchor_b + travel * joint.axis_b);
}

/// A force per row, with which a joint exerts given forces on two bodies.
Eigen::VectorXd row_forces(const Block& block, const Eigen::Matrix<double, 12, 1>& on_bodies) {
  Eigen::MatrixXd J(12, block.rows);
  for (int row = 0; row < block.rows; ++row) {
    J.col(row) << gradient(block, row, block.a == 0), gradient(block, row, block.a != 0);
  }
  return least_squares(J, on_bodies);
}

// A closed joint with a and b exchanged, which exerts the same forces, has the same mean stiffness.
template <class Rows, class JointType>
void mean_stiffness_has_no_order() {
  Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = joined<JointType>(random, false);
    const State state = initial_state(scene);
    auto& joint = std::get<JointType>(scene.joints[0]);
    if constexpr (requires { joint.across_a; }) {
      close(joint, state, JointType::kSlides ? uniform(random, -1.0, 1.0) : 0.0);
    } else {
      close(joint, state);
    }
    Blocks blocks;
    joint_rows(scene)(state, blocks);
    Block& block = blocks.all()[0];
    for (int row = 0; row < block.rows; ++row) block.lambda[row] = uniform(random, 0.5, 2.0);
    std::swap(joint.a, joint.b);
    std::swap(joint.anchor_a, joint.anchor_b);
    std::swap(joint.axis_a, joint.axis_b);
    if constexpr (requires { joint.across_a; }) std::swap(joint.across_a, joint.across_b);
    Blocks exchanged;
    joint_rows(scene)(state, exchanged);
    Block& other = exchanged.all()[0];
    Eigen::Matrix<double, 12, 1> forces;
    forces << force_on(blocks, 0), force_on(blocks, 1);
    Eigen::Map<Eigen::VectorXd>(other.lambda, other.rows) = row_forces(other, forces);
    StiffnessMatrix K;
    StiffnessMatrix K_other;
    StiffnessMatrix K_one;
    for (StiffnessMatrix* of : {&K, &K_other, &K_one}) of->clear(2);
    Rows::mean_stiffness(block, K);
    Rows::mean_stiffness(other, K_other);
    Rows::stiffness(block, K_one);
    double difference = 0.0;
    for (int row = 0; row < 2; ++row) {
      EXPECT_LT((force_on(blocks, row) - force_on(exchanged, row)).norm(), 1e-12);
      for (int col = 0; col < 2; ++col) {
        EXPECT_LT((K.block(row, col) - K_other.block(row, col)).norm(), 1e-12) << row << col;
        difference += (K.block(row, col) - K_one.block(row, col)).norm();
      }
    }
    EXPECT_GT(difference, 0.1) << "of one order";
  }
}

TEST(HingeJoint, MeanStiffnessHasNoOrder) { mean_stiffness_has_no_order<HingeRows, HingeJoint>(); }
TEST(WeldJoint, MeanStiffnessHasNoOrder) { mean_stiffness_has_no_order<WeldRows, WeldJoint>(); }
TEST(PrismaticJoint, MeanStiffnessHasNoOrder) {
  mean_stiffness_has_no_order<PrismaticRows, PrismaticJoint>();
}

TEST(CylindricalJoint, MeanStiffnessHasNoOrder) {
  mean_stiffness_has_no_order<CylindricalRows, CylindricalJoint>();
}

// The joint with a and b exchanged is the same constraint, even off it.
TEST(UniversalJoint, StiffnessHasNoOrder) {
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = joined<UniversalJoint>(random, false);
    const State state = initial_state(scene);
    Blocks blocks;
    joint_rows(scene)(state, blocks);
    Block& block = blocks.all()[0];
    for (int row = 0; row < block.rows; ++row) block.lambda[row] = uniform(random, 0.5, 2.0);
    auto& joint = std::get<UniversalJoint>(scene.joints[0]);
    std::swap(joint.a, joint.b);
    std::swap(joint.anchor_a, joint.anchor_b);
    std::swap(joint.axis_a, joint.axis_b);
    Blocks exchanged;
    joint_rows(scene)(state, exchanged);
    Block& other = exchanged.all()[0];
    for (int row = 0; row < 3; ++row) other.lambda[row] = -block.lambda[row];
    other.lambda[3] = block.lambda[3];
    StiffnessMatrix K;
    StiffnessMatrix K_other;
    for (StiffnessMatrix* of : {&K, &K_other}) of->clear(2);
    UniversalRows::stiffness(block, K);
    UniversalRows::stiffness(other, K_other);
    for (int row = 0; row < 2; ++row) {
      EXPECT_LT((force_on(blocks, row) - force_on(exchanged, row)).norm(), 1e-12);
      for (int col = 0; col < 2; ++col) {
        EXPECT_GT(K.block(row, col).norm(), 1e-3);
        EXPECT_LT((K.block(row, col) - K_other.block(row, col)).norm(), 1e-12) << row << col;
      }
    }
  }
}

/// d2phi/dt2 of a joint against its errors a little earlier and later, at constant velocities.
template <class JointType>
void curvature() {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = joined<JointType>(random, trial % 4 == 0);
    const std::size_t n = scene.bodies.size();
    State state = initial_state(scene);
    for (Vec6& u : state.u) u << random_vector(random), random_vector(random);
    const auto phi_at = [&](double t) {
      State then = state;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 omega = state.u[i].tail<3>();
        then.x[i] += t * state.u[i].head<3>();
        then.q[i] = Quat(Eigen::AngleAxisd(t * omega.norm(), omega.normalized())) * state.q[i];
      }
      Blocks blocks;
      JointStage(scene).append(whole(scene), then, rotations(then), blocks);
      return blocks.all()[0];
    };
    const double t = 1e-4;
    const Block now = phi_at(0.0);
    const Block before = phi_at(-t);
    const Block after = phi_at(t);
    const Vec6 u_b = n > 1 ? state.u[1] : Vec6(Vec6::Zero());
    double found[kMaxRows];
    with_joint_rows(now.kind, [&](auto joint) { joint.curvature(now, state.u[0], u_b, found); });
    for (int row = 0; row < now.rows; ++row) {
      const double expected = (before.phi[row] - 2.0 * now.phi[row] + after.phi[row]) / (t * t);
      EXPECT_NEAR(found[row], expected, 1e-6) << row;
    }
  }
}

TEST(BallJoint, CurvatureMatchesFiniteDifferences) { curvature<BallJoint>(); }
TEST(HingeJoint, CurvatureMatchesFiniteDifferences) { curvature<HingeJoint>(); }
TEST(PrismaticJoint, CurvatureMatchesFiniteDifferences) { curvature<PrismaticJoint>(); }
TEST(WeldJoint, CurvatureMatchesFiniteDifferences) { curvature<WeldJoint>(); }
TEST(DistanceJoint, CurvatureMatchesFiniteDifferences) { curvature<DistanceJoint>(); }
TEST(UniversalJoint, CurvatureMatchesFiniteDifferences) { curvature<UniversalJoint>(); }
TEST(CylindricalJoint, CurvatureMatchesFiniteDifferences) { curvature<CylindricalJoint>(); }

/// The stated change of a joint type's row forces as bodies move, and their couple and force,
/// against the gradients before and after.
template <class JointType>
void pushes() {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = joined<JointType>(random, trial % 4 == 0);
    State state = initial_state(scene);
    const Rows rows = joint_rows(scene);
    Blocks before;
    rows(state, before);
    const Block& block = before.all()[0];
    double force[kMaxRows];
    for (double& f : force) f = random_vector(random).x();
    Vec6 on[2] = {Vec6::Zero(), Vec6::Zero()};
    push(block, force, &on[0], &on[1]);
    Vec3 at_anchor;
    Vec3 couple;
    with_joint_rows(block.kind, [&](auto joint) {
      at_anchor = joint.force(block, force);
      couple = joint.torque(block, force);
    });
    EXPECT_LT((on[0].head<3>() - at_anchor).norm(), 1e-13);
    EXPECT_LT((on[0].tail<3>() - (block.r_a.cross(at_anchor) + couple)).norm(), 1e-13);

    std::vector<Vec6> u(scene.bodies.size());
    for (Vec6& v : u) v << random_vector(random), random_vector(random);
    const double dt = 0.4;
    const auto of = [&](int body) { return body < 0 ? Motion{} : motion(u[index(body)], dt); };
    Vec6 change[2] = {Vec6::Zero(), Vec6::Zero()};
    with_joint_rows(block.kind, [&](auto joint) {
      joint.push_change(block, of(block.a), of(block.b), force, change[0], change[1]);
    });
    integrate(whole(scene), dt, u, state);
    Blocks after;
    rows(state, after);
    Vec6 later[2] = {Vec6::Zero(), Vec6::Zero()};
    push(after.all()[0], force, &later[0], &later[1]);
    EXPECT_LT((later[0] - on[0] - change[0]).norm(), 1e-12);
    EXPECT_TRUE(block.b < 0 || (later[1] - on[1] - change[1]).norm() < 1e-12);
  }
}

TEST(BallJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<BallJoint>(); }
TEST(HingeJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<HingeJoint>(); }
TEST(PrismaticJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<PrismaticJoint>(); }
TEST(WeldJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<WeldJoint>(); }
TEST(DistanceJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<DistanceJoint>(); }
TEST(UniversalJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<UniversalJoint>(); }
TEST(CylindricalJoint, ForcesAndTheirChangesMatchTheGradients) { pushes<CylindricalJoint>(); }

TEST(HingeJoint, VectorsAcrossTheAxisAreOrthonormal) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 axis = random_vector(random).normalized();
    Vec3 v1;
    Vec3 v2;
    across(axis, v1, v2);
    Mat3 R;
    R << axis, v1, v2;
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
  }
}

TEST(HingeJoint, TurningAboutTheAxisIsNoError) {
  Scene scene;
  scene.bodies.push_back(moving(Box{}));
  HingeJoint hinge;
  hinge.axis_a = hinge.axis_b = Vec3{2.0, 1.0, -1.0}.normalized();
  scene.joints.push_back(hinge);
  State state = initial_state(scene);
  state.q[0] = Quat(Eigen::AngleAxisd(1.2, hinge.axis_a));
  EXPECT_LT(JointStage(scene).errors(state, rotations(state)).sum, 1e-15);
}

TEST(JointStage, ErrorsAreTheSumAndTheLargestGap) {
  Scene scene;
  scene.bodies = {moving(Sphere{}), moving(Sphere{})};
  BallJoint joint;
  joint.b = kWorld;
  joint.anchor_b = {0.3, -0.4, 0.0};
  scene.joints.push_back(joint);
  joint.a = 1;
  joint.anchor_b = {0.0, 0.0, 0.1};
  scene.joints.push_back(joint);
  const State state = initial_state(scene);
  const JointErrors errors = JointStage(scene).errors(state, rotations(state));
  EXPECT_DOUBLE_EQ(errors.sum, 0.8);
  EXPECT_DOUBLE_EQ(errors.gap, 0.5);
  EXPECT_EQ(errors.joint, 0);
}

}  // namespace
}  // namespace substep::test
