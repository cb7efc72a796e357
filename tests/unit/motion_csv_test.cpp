// A run as tables of bodies and joints, and the sums over bodies.

#include "core/io/motion_csv.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/simulator.hpp"
#include "tests/support/run.hpp"
#include "tests/support/steady_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// A box on a hinge about z, held with an offset of 0.5 m from the anchor along the axis: gravity
/// bends the hinge.
Scene cantilever() {
  Scene scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.bodies = {moving(Box{{0.1, 0.2, 0.5}}, 2.0)};
  scene.bodies[0].name = "beam";
  scene.bodies[0].position = {1.0, 2.0, 3.5};
  HingeJoint hinge;
  hinge.name = "root, \"left\"";
  hinge.anchor_a = {0.0, 0.0, -0.5};
  hinge.anchor_b = {1.0, 2.0, 3.0};
  scene.joints.emplace_back(hinge);
  return scene;
}

TEST(MotionCsv, JointForceAndTorqueAreThoseOnBodyAAboutItsAnchor) {
  const Scene scene = cantilever();
  Simulator simulator = simulator_of(scene, {.mode = Mode::kConst, .n = 4});
  EXPECT_TRUE(simulator.constraint_forces().joints.empty());
  for (int frame = 0; frame < 3; ++frame) simulator.step();
  const JointForce on_a = simulator.constraint_forces().joints.at(0);
  EXPECT_TRUE(on_a.known);
  // Weight m g down at the centre: the hinge pushes up by m g, and its torque about the anchor is
  // minus that of the weight, r x F = (0.5 m g, 0, 0). Only rounding of a solve remains.
  EXPECT_LT((on_a.force - Vec3(0.0, 2.0 * 9.81, 0.0)).norm(), 1e-10);
  EXPECT_LT((on_a.torque - Vec3(-0.5 * 2.0 * 9.81, 0.0, 0.0)).norm(), 1e-10);
}

TEST(MotionCsv, NamesAreQuotedAndNumbersAreExact) {
  const Scene scene = cantilever();
  Simulator simulator = simulator_of(scene, {.mode = Mode::kConst, .n = 4});
  EXPECT_EQ(joints_lines(scene, simulator.state(), simulator.constraint_forces()),
            "0,0,\"root, \"\"left\"\"\",nan,nan,nan,nan,nan,nan,0,nan\n")
      << "before the first sub-step no force is known";
  const FrameReport report = simulator.step();
  EXPECT_EQ(joints_lines(scene, simulator.state(), simulator.constraint_forces())
                .find("1," + number_text(report.time) + ",\"root, \"\"left\"\"\","),
            0U);
  EXPECT_EQ(states_lines(scene, initial_state(scene)), "0,0,beam,1,2,3.5,1,0,0,0,0,0,0,0,0,0\n");
}

// A ball on a rod of 0.5 m: without gravity the force points from it to the anchor.
TEST(MotionCsv, JointForcesSayTheTimeToWhichTheyBelong) {
  Scene scene;
  scene.effects.joints = true;
  scene.bodies = {moving(Sphere{0.1}, 2.0)};
  scene.bodies[0].position = {0.5, 0.0, 0.0};
  scene.bodies[0].velocity = {0.0, 1.0, 0.0};
  scene.bodies[0].angular_velocity = {0.0, 0.0, 2.0};
  BallJoint ball;
  ball.a = 0;
  ball.anchor_a = {-0.5, 0.0, 0.0};
  scene.joints.emplace_back(ball);
  struct Method {
    SolverKind solver;
    Forces forces;
    Integrator integrator;
    bool at_end;
  };
  constexpr Method kMethods[] = {
      {SolverKind::kBpp, Forces::kEnd, Integrator::kEuler, false},
      {SolverKind::kBpp, Forces::kEnd, Integrator::kLeapfrog, false},
      {SolverKind::kBpp, Forces::kEnd, Integrator::kStormer, false},
      {SolverKind::kPgs, Forces::kEnd, Integrator::kLeapfrog, false},
      {SolverKind::kNewton, Forces::kMean, Integrator::kLeapfrog, false},
      {SolverKind::kNewton, Forces::kNumerov, Integrator::kLeapfrog, false},
      {SolverKind::kNewton, Forces::kEnd, Integrator::kLeapfrog, true},
      {SolverKind::kXpbd, Forces::kEnd, Integrator::kLeapfrog, true}};
  for (const Method& method : kMethods) {
    substep::Settings settings = steady_at(1);
    settings.solver = method.solver;
    settings.forces = method.forces;
    settings.integrator = method.integrator;
    Simulator simulator = simulator_of(scene, settings);
    const double turned = 2.0 * scene.frame;
    for (int frame = 0; frame < 20; ++frame) {
      const State before = simulator.state();
      simulator.step();
      const State& then = method.at_end ? simulator.state() : before;
      const JointForce force = simulator.constraint_forces().joints.at(0);
      EXPECT_NEAR(force.time, then.time, 1e-12) << frame;
      const double off = force.force.normalized().cross(then.x[0].normalized()).norm();
      EXPECT_LT(off, turned * turned)
          << frame << " " << name_of(method.solver) << " " << name_of(method.integrator);
    }
  }
}

TEST(MotionCsv, TheGapOfASlideIsNotItsTravel) {
  Scene scene;
  scene.effects.joints = true;
  scene.bodies = {moving(Sphere{0.1})};
  scene.bodies[0].position = {0.3, 0.4, 0.0};
  PrismaticJoint slide;
  slide.name = "slide";
  slide.a = 0;
  slide.axis_a = slide.axis_b = Vec3::UnitX();
  slide.across_a = slide.across_b = Vec3::UnitY();
  scene.joints.emplace_back(slide);
  EXPECT_EQ(joints_lines(scene, initial_state(scene), {}),
            "0,0,slide,nan,nan,nan,nan,nan,nan,0.4,nan\n");
}

TEST(MotionCsv, VelocitiesAreThoseAtTheTimeOfThePoses) {
  Scene scene;
  scene.effects.gravity = true;
  scene.bodies = {moving(Sphere{}), fixed(Plane{})};
  Simulator simulator =
      simulator_of(scene, {.mode = Mode::kConst, .n = 2, .integrator = Integrator::kLeapfrog});
  simulator.step();
  std::istringstream lines(states_lines(scene, simulator.state()));
  std::string ball;
  std::string plane;
  std::getline(lines, ball);
  std::getline(lines, plane);
  std::vector<double> cells;
  std::istringstream row(ball);
  for (std::string cell; std::getline(row, cell, ',');) {
    cells.push_back(parse_number(cell).value_or(-99.0));
  }
  ASSERT_EQ(cells.size(), 16U);
  const double t = scene.frame;
  EXPECT_NEAR(cells[4], -0.5 * 9.81 * t * t, 1e-15);
  EXPECT_NEAR(cells[11], -9.81 * t, 1e-15) << "leapfrog keeps u at the middle of a sub-step";
  EXPECT_EQ(plane, "1," + number_text(t) + ",,0,0,0,1,0,0,0,0,0,0,0,0,0");
}

TEST(Momentum, IsThatOfCentresAndOfSpins) {
  Scene scene;
  scene.bodies = {moving(Box{{0.4, 0.15, 0.05}}, 3.0), fixed(Sphere{})};
  scene.bodies[1].velocity = {9.0, 9.0, 9.0};  // must not matter
  Body& body = scene.bodies[0];
  body.position = {1.0, -2.0, 0.5};
  body.velocity = {0.3, 0.7, -1.1};
  body.orientation = Quat(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()));
  body.angular_velocity = {2.0, -3.0, 1.0};
  const Momenta p = momenta_of(scene, initial_state(scene));
  const Mat3 R = body.orientation.toRotationMatrix();
  const Mat3 inertia_W = R * body.inertia.asDiagonal() * R.transpose();
  EXPECT_LT((p.linear - 3.0 * body.velocity).norm(), 1e-14);
  EXPECT_LT(
      (p.angular - 3.0 * body.position.cross(body.velocity) - inertia_W * body.angular_velocity)
          .norm(),
      1e-13);
}

}  // namespace
}  // namespace substep::test
