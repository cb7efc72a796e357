// Largest steps of chains and mechanisms in closed form, and the reduced matrices.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/lab/linear_model.hpp"
#include "core/model/scene_builder.hpp"
#include "tests/support/dense_oracle.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/two_rods.hpp"

namespace substep {
namespace {

constexpr double kWeight = 9.81;  // of 1 kg [N]

/// n balls on rods of a length, hanging at rest; the last has another mass.
Scene chain(int n, double length, double mass, double last) {
  SceneBuilder builder("chain");
  int above = kWorld;
  for (int i = 0; i < n; ++i) {
    const Vec3 at{0.0, -length * (i + 1), 0.0};
    const int ball = builder.add_body(Sphere{0.01}, i + 1 < n ? mass : last, at);
    builder.body(ball).collides = false;
    builder.add_distance(ball, above, at, at + Vec3(0.0, length, 0.0));
    above = ball;
  }
  return *builder.build();
}

LinearModel model_of(const Scene& scene) {
  const auto models = LinearModel::of(scene, initial_state(scene));
  EXPECT_EQ(models.size(), 1U);
  return models.front();
}

double step_of(const LinearModel& model) {
  return largest_step(LinearSystem{model.mass(), model.geometric(), {}}).step;
}

/// The largest root of the Laguerre polynomial L_n: the largest eigenvalue of its Jacobi matrix,
/// with 2 i + 1 on the diagonal and i beside it (Golub and Welsch 1969).
double largest_laguerre_root(int n) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    J(i, i) = 2.0 * i + 1.0;
    if (i > 0) J(i, i - 1) = J(i - 1, i) = i;
  }
  return test::largest_eigenvalue(J, Eigen::MatrixXd::Identity(n, n));
}

// w^2 = g/l x, x the roots of L_n: for n = 2, 2 +- sqrt 2.
TEST(LinearModel, OfAHangingChainHasTheRootsOfLaguerre) {
  EXPECT_NEAR(largest_laguerre_root(2), 2.0 + std::sqrt(2.0), 1e-14);
  for (int n = 1; n <= repetitions(50, 20); ++n) {
    const LinearModel model = model_of(chain(n, 0.4, 0.7, 0.7));
    const double exact = 2.0 / std::sqrt(kWeight / 0.4 * largest_laguerre_root(n));
    EXPECT_NEAR(step_of(model), exact, 1e-9 * exact) << n;
    EXPECT_EQ(model.size(), 5 * n);
    EXPECT_EQ(model.redundant(), 0);
  }
}

// Against the n x n matrix: T_i/l of the rod above, and of that below.
TEST(LinearModel, OfAChainWithALoadAtItsEnd) {
  for (const double load : {1.0, 30.0, 1000.0}) {
    for (const int n : {2, 3, 10, 40}) {
      const double length = 0.25;
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
      Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
      M(n - 1, n - 1) = load;
      for (int i = 0; i < n; ++i) {
        const double tension = kWeight * (load + n - 1 - i);  // of the rod above body i
        K(i, i) += tension / length;
        if (i == 0) continue;
        K(i - 1, i - 1) += tension / length;
        K(i, i - 1) -= tension / length;
        K(i - 1, i) -= tension / length;
      }
      const double exact = 2.0 / std::sqrt(test::largest_eigenvalue(K, M));
      const LinearModel model = model_of(chain(n, length, 1.0, load));
      EXPECT_NEAR(step_of(model), exact, 1e-9 * exact) << load << " " << n;
      const StepLimit limit = largest_step(LinearSystem{model.mass(), model.geometric(), {}});
      double sum = 0.0;
      for (const auto& share : model.joints_of(limit.mode)) sum += share.share;
      EXPECT_NEAR(sum, 1.0, 1e-9);
      sum = 0.0;
      for (const auto& share : model.bodies_of(limit.mode)) sum += share.share;
      EXPECT_NEAR(sum, 1.0, 1e-9);
    }
  }
}

// A rigid pendulum: w^2 = m g d/(I + m d^2 + a), on a hinge in any direction that is level.
TEST(LinearModel, OfAPendulumWithAnArmature) {
  for (const double armature : {0.0, 0.3}) {
    SceneBuilder builder("pendulum");
    const int rod = builder.add_body(Box{{0.05, 0.5, 0.1}}, 2.0, {0.0, -0.5, 0.0});
    const int hinge = builder.add_hinge(rod, kWorld, Vec3::Zero(), {3.0, 0.0, 4.0});
    if (armature > 0.0) builder.add_armature(hinge, armature);
    const Scene scene = *builder.build();
    const Vec3 axis = Vec3(3.0, 0.0, 4.0).normalized();
    const double inertia =
        axis.dot(scene.bodies[0].inertia.cwiseProduct(axis)) + 2.0 * 0.25 + armature;
    const LinearModel model = model_of(scene);
    ASSERT_EQ(model.size(), 1);
    const double square = 2.0 * kWeight * 0.5 / inertia;
    EXPECT_NEAR(model.geometric()(0, 0) / model.mass()(0, 0), square, 1e-9 * square);
    EXPECT_NEAR(step_of(model), 2.0 / std::sqrt(square), 1e-9);
    const auto coordinate = model.coordinates_of(Eigen::VectorXd::Ones(1));
    ASSERT_EQ(coordinate.size(), 1U);
    EXPECT_EQ(coordinate[0].index, 0);
    EXPECT_NEAR(1.0 / coordinate[0].share, inertia - armature, 1e-9);
  }
}

// A ball on an arm: the criterion's step is far from that of the motion.
TEST(LinearModel, OfABallOnAnArmIsNotTheCriterions) {
  SceneBuilder builder("ball");
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {0.0, -1.0, 0.0});
  builder.add_ball_joint(ball, kWorld, Vec3::Zero());
  const LinearModel model = model_of(*builder.build());
  EXPECT_NEAR(step_of(model), 2.0 / std::sqrt(kWeight / 1.004), 1e-9);
  EXPECT_NEAR(2.0 / std::sqrt(model.r()), 0.040, 5e-4);
}

// Inertia of a drive's coordinate with the other joints: the arm's second hinge is free.
TEST(LinearModel, OfADriveHasTheInertiaOfItsCoordinate) {
  SceneBuilder builder("arm");
  int last = kWorld;
  for (int i = 0; i < 2; ++i) {
    const int rod = builder.add_body(Box{{0.5, 0.05, 0.05}}, 1.0 + i, {0.5 + i, 0.0, 0.0});
    const int hinge = builder.add_hinge(rod, last, {1.0 * i, 0.0, 0.0}, Vec3::UnitZ());
    builder.add_armature(hinge, 0.2 + 0.3 * i);
    builder.drive(hinge, {.stiffness = 50.0, .damping = 1.0 + i});
    last = rod;
  }
  builder.scene().gravity.setZero();
  const Scene scene = *builder.build();
  const Eigen::Matrix2d M = test::inertia_of_two_rods(scene);
  const Eigen::Matrix2d inverse = M.inverse();
  const LinearModel model = model_of(scene);
  ASSERT_EQ(model.size(), 2);
  ASSERT_EQ(model.drives().size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const auto& drive = model.drives()[static_cast<std::size_t>(i)];
    EXPECT_EQ(drive.joint, i);
    EXPECT_NEAR(drive.inertia, 1.0 / inverse(i, i), 1e-9);
    EXPECT_EQ(drive.stiffness, 50.0);
    EXPECT_EQ(drive.damping, 1.0 + i);
  }
  EXPECT_LT(model.geometric().norm(), 1e-9) << "no forces";
}

// A box on two parallel hinges: the second implies the rows of the first.
TEST(LinearModel, CountsRedundantRows) {
  SceneBuilder builder("door");
  const int door = builder.add_body(Box{{0.5, 1.0, 0.05}}, 5.0, {0.5, 0.0, 0.0});
  builder.add_hinge(door, kWorld, {0.0, 0.8, 0.0}, Vec3::UnitY());
  builder.add_hinge(door, kWorld, {0.0, -0.8, 0.0}, Vec3::UnitY());
  const LinearModel model = model_of(*builder.build());
  EXPECT_EQ(model.size(), 1);
  EXPECT_EQ(model.redundant(), 5);
}

// Joint forces follow the velocities: a ball that circles at w has the tension m w^2 l + m g.
TEST(LinearModel, IncludesCentripetalForces) {
  Scene scene = chain(1, 0.5, 2.0, 2.0);
  scene.bodies[0].velocity = {3.0, 0.0, 0.0};
  const LinearModel model = model_of(scene);
  EXPECT_NEAR(model.largest_force(), 2.0 * (kWeight + 9.0 / 0.5), 1e-9);
}

}  // namespace
}  // namespace substep
