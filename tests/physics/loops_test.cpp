// Closed loops of hinges, whose rows are redundant: on a body of the loop, where pivots are bounded
// (solver/saddle_factor.cpp), and in the whole system. Refinement corrects the effect
// (saddle_refine.cpp), so loops keep the order of their integrator and hold to its truncation
// error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/model/validate.hpp"
#include "core/solver/bpp.hpp"
#include "scenes/generator/bricard.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"

namespace substep {
namespace {

using test::kGravity;

HingeJoint hinge(int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
  HingeJoint joint;
  joint.name = "hinge " + std::to_string(a) + " " + std::to_string(b);
  joint.a = a;
  joint.b = b;
  joint.anchor_a = anchor_a;
  joint.anchor_b = anchor_b;
  joint.axis_a = Vec3::UnitZ();
  joint.axis_b = Vec3::UnitZ();
  return joint;
}

/// Two rods of 1 kg and 1 m hang side by side and carry a coupler of 300 kg: a four-bar of exact
/// hinges, three of whose rows are redundant. It is pushed at 1 m/s and stays under the horizontal,
/// where it would be singular.
constexpr double kCoupler = 300.0;
Scene swing() {
  Scene scene;
  scene.name = "swing";
  scene.frame = 1.0 / 60.0;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, -kGravity, 0.0};
  const auto rod = [](const Vec3& centre, const Vec3& velocity, double spin) {
    Body body;
    body.name = "rod";
    body.shape = Box{{0.02, 0.5, 0.02}};
    body.inertia = {1.0 / 12.0, 1e-3, 1.0 / 12.0};
    body.position = centre;
    body.velocity = velocity;
    body.angular_velocity = {0.0, 0.0, spin};
    return body;
  };
  scene.bodies = {rod({0.0, -0.5, 0.0}, {0.5, 0.0, 0.0}, 1.0),
                  rod({1.0, -0.5, 0.0}, {0.5, 0.0, 0.0}, 1.0),
                  rod({0.5, -1.0, 0.0}, {1.0, 0.0, 0.0}, 0.0)};
  scene.bodies[2].mass = kCoupler;
  scene.bodies[2].inertia = kCoupler * Vec3(1e-3, 1.0 / 12.0, 1.0 / 12.0);
  const Vec3 up{0.0, 0.5, 0.0};
  const Vec3 right{0.5, 0.0, 0.0};
  scene.joints = {hinge(0, up, kWorld, Vec3::Zero()), hinge(1, up, kWorld, Vec3::UnitX()),
                  hinge(0, -up, 2, -right), hinge(1, -up, 2, right)};
  return scene;
}

/// Angle of its rods after each frame, by the classical Runge-Kutta method [rad].
std::vector<double> swing_angles(double frame, int frames) {
  constexpr double kSquare = (1.0 + kCoupler) * kGravity / (2.0 / 3.0 + kCoupler);  // [1/s^2]
  constexpr int kSteps = 64;
  const double h = frame / kSteps;
  const auto f = [](double angle) { return -kSquare * std::sin(angle); };
  std::vector<double> angles;
  double angle = 0.0;
  double speed = 1.0;
  for (int i = 0; i < frames; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double a1 = f(angle);
      const double v2 = speed + 0.5 * h * a1;
      const double a2 = f(angle + 0.5 * h * speed);
      const double v3 = speed + 0.5 * h * a2;
      const double a3 = f(angle + 0.5 * h * v2);
      const double v4 = speed + h * a3;
      const double a4 = f(angle + h * v3);
      angle += h / 6.0 * (speed + 2.0 * v2 + 2.0 * v3 + v4);
      speed += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    angles.push_back(angle);
  }
  return angles;
}

Settings stormer(const Scene& scene, int n) {
  Settings settings = scene.settings;
  settings.mode = Mode::kConst;
  settings.n = n;
  settings.integrator = Integrator::kStormer;
  return settings;
}

/// A case of the exam with exact hinges.
ExamCase exact(ExamCase exam) {
  exam.scene.settings = substep::Settings{};
  for (Joint& joint : exam.scene.joints) {
    base(joint).compliance = 0.0;
    std::get<HingeJoint>(joint).angular_compliance = 0.0;
  }
  return exam;
}

struct Found {
  std::vector<double> errors;  // as the case of the exam names them
  double gap = 0.0;            // largest [m]
};

Found run_case(const ExamCase& exam, int n) {
  Found found;
  found.errors.assign(exam.quantities.size(), 0.0);
  const ExamMeasure measure = exam.measure();
  Simulator simulator = test::simulator_of(exam.scene, stormer(exam.scene, n));
  measure({exam.scene, simulator.state(), simulator.observe(), {}}, found.errors);
  const auto frames = std::lround(exam.scene.criteria.duration / exam.scene.frame);
  for (long i = 0; i < frames; ++i) {
    const FrameReport report = simulator.step();
    measure({exam.scene, simulator.state(), report, {}}, found.errors);
    keep_largest(found.gap, report.joint_gap);
  }
  return found;
}

double order(const Found& coarse, const Found& fine, double ratio) {
  return std::log(coarse.errors[0] / fine.errors[0]) / std::log(ratio);
}

// Formerly 2e-11 m at any N, from the softness of the pivots.
TEST(Loops, AFourBarWithAHeavyCouplerIsExactToRounding) {
  constexpr int kFrames = 300;
  const Scene scene = swing();
  const std::vector<double> exact = swing_angles(scene.frame, kFrames);
  for (const int n : {16, 64}) {
    Simulator simulator = test::simulator_of(scene, stormer(scene, n));
    double error = 0.0;
    double gap = 0.0;
    for (const double angle : exact) {
      const FrameReport report = simulator.step();
      keep_largest(gap, report.joint_gap);
      const Vec3 coupler{0.5 + std::sin(angle), -std::cos(angle), 0.0};
      keep_largest(error, (simulator.state().x[2] - coupler).norm());
    }
    EXPECT_LT(error, n == 16 ? 1e-10 : 1e-12) << n;
    EXPECT_LT(gap, 1e-13) << n;
  }
}

// Formerly 3e-6 m at 16, 2e-7 at 64, with hinges of 1e-16 m/N; millimetres with exact ones.
TEST(Loops, BricardsMechanismIsOfFourthOrder) {
  const ExamCase exam = exact(scenes::exam_bricard());
  const Found coarse = run_case(exam, 16);
  const Found middle = run_case(exam, 32);
  const Found fine = run_case(exam, 64);
  const Found finest = run_case(exam, 256);
  EXPECT_LT(coarse.errors[0], 2e-7);
  EXPECT_GT(order(coarse, middle, 2.0), 4.0);
  EXPECT_GT(order(middle, fine, 2.0), 3.8);
  EXPECT_LT(finest.errors[0], 2e-11);
  EXPECT_LT(finest.errors[1], 1e-10) << "energy";
}

// The pivot of a redundant row was clamped, which dropped the row: the velocities had one choice of
// the redundant forces, the rates of the forces another, and Numerov's weights second order, 2e-7 m
// at 16.
TEST(Loops, NumerovIsOfFourthOrderInBricardsMechanism) {
  const ExamCase exam = exact(scenes::exam_bricard());
  const auto error = [&](int n) {
    Settings settings = stormer(exam.scene, n);
    settings.solver = SolverKind::kNewton;
    settings.forces = Forces::kNumerov;
    settings.integrator = Integrator::kLeapfrog;
    Simulator simulator = test::simulator_of(exam.scene, settings);
    scenes::Bricard motion;
    double largest = 0.0;
    while (simulator.state().time < 0.5) {
      simulator.step();
      motion.advance(simulator.state().time);
      keep_largest(largest, (simulator.state().x[4] - motion.centre(4)).norm());
    }
    return largest;
  };
  EXPECT_LT(error(16), error(4) / 100.0);
  EXPECT_LT(error(16), 1e-9);
}

// It passes the singular pose ten times; the errors of 64 and more formerly stopped at some 1e-6.
TEST(Loops, TheDoubleFourBarKeepsItsOrderThroughTheSingularPose) {
  const ExamCase exam = exact(scenes::exam_four_bar());
  const Found coarse = run_case(exam, 32);
  const Found fine = run_case(exam, 64);
  const Found finest = run_case(exam, 256);
  EXPECT_GT(order(coarse, fine, 2.0), 4.5);
  EXPECT_GT(order(fine, finest, 4.0), 4.3);
  EXPECT_LT(finest.errors[1], 1e-9) << "published position after 10 s";
  EXPECT_LT(finest.errors[2], 3e-9) << "published velocity after 10 s";
}

// With the usual frame of 1/60 s.
TEST(Loops, JointsStayClosed) {
  for (ExamCase exam : {exact(scenes::exam_four_bar()), exact(scenes::exam_bricard())}) {
    exam.scene.frame = 1.0 / 60.0;
    Simulator simulator = test::simulator_of(exam.scene, stormer(exam.scene, 16));
    double gap = 0.0;
    for (int i = 0; i < 600; ++i) keep_largest(gap, simulator.step().joint_gap);
    EXPECT_LT(gap, 1e-11) << exam.name;
  }
}

/// Largest joint forces and torques of a run, and those out of a plane.
struct Largest {
  double force = 0.0;            // [N]
  double torque = 0.0;           // [N m]
  double force_across = 0.0;     // along the normal
  double torque_in_plane = 0.0;  // about axes in the plane
  int substeps = 0;
};

Largest largest_forces(const Scene& scene, const Vec3& normal) {
  Simulator simulator = test::simulator_of(scene, substep::Settings{});
  Largest most;
  for (int i = 0; i < 120; ++i) {
    most.substeps += simulator.step().n_substeps;
    if (i == 0) continue;  // it may begin without a known stiffness
    for (const JointForce& joint : simulator.constraint_forces().joints) {
      keep_largest(most.force, joint.force.norm());
      keep_largest(most.torque, joint.torque.norm());
      keep_largest(most.force_across, std::abs(joint.force.dot(normal)));
      most.torque_in_plane =
          std::max(most.torque_in_plane, (joint.torque - joint.torque.dot(normal) * normal).norm());
    }
  }
  return most;
}

// Forces that act on nothing are zero, in any axes.
TEST(Loops, RedundantRowsOfAPlanarLoopPressOnNothing) {
  const Largest planar = largest_forces(swing(), Vec3::UnitZ());
  const Quat turn = Quat{0.3, -0.5, 0.7, 0.4}.normalized();
  const Largest turned =
      largest_forces(test::transformed(swing(), turn, Vec3::Zero()), turn * Vec3::UnitZ());
  for (const Largest& most : {planar, turned}) {
    EXPECT_GT(most.force, 1000.0);
    EXPECT_LT(most.force_across, 0.01 * most.force);
    EXPECT_LT(most.torque_in_plane, 0.01 * most.force);
  }
  EXPECT_EQ(planar.substeps, turned.substeps);
  EXPECT_NEAR(planar.force, turned.force, 1e-6 * planar.force);
}

/// The scene in other units: a metre is `length`, a kilogram is `mass` of them.
Scene in_units(Scene scene, double length, double mass) {
  for (Body& body : scene.bodies) {
    std::get<Box>(body.shape).half_extents *= length;
    body.mass *= mass;
    body.inertia *= mass * length * length;
    body.position *= length;
    body.velocity *= length;
  }
  for (Joint& joint : scene.joints) {
    base(joint).anchor_a *= length;
    base(joint).anchor_b *= length;
  }
  scene.gravity *= length;
  return scene;
}

/// The scene with bodies and joints in reverse order, and the bodies of joints swapped.
Scene reversed(Scene scene) {
  const auto last = static_cast<int>(scene.bodies.size()) - 1;
  const auto place = [last](int body) { return body == kWorld ? kWorld : last - body; };
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  std::reverse(scene.joints.begin(), scene.joints.end());
  for (Joint& joint : scene.joints) {
    auto& of_hinge = std::get<HingeJoint>(joint);
    of_hinge.a = place(of_hinge.a);
    of_hinge.b = place(of_hinge.b);
    if (of_hinge.b == kWorld) continue;  // a moves
    std::swap(of_hinge.a, of_hinge.b);
    std::swap(of_hinge.anchor_a, of_hinge.anchor_b);
    std::swap(of_hinge.axis_a, of_hinge.axis_b);
  }
  return scene;
}

TEST(Loops, RedundantRowsDependOnNoUnitsAndOrder) {
  const Largest here = largest_forces(swing(), Vec3::UnitZ());
  const Largest other_order = largest_forces(reversed(swing()), Vec3::UnitZ());
  EXPECT_EQ(other_order.substeps, here.substeps);
  EXPECT_NEAR(other_order.force, here.force, 1e-6 * here.force);
  for (const auto& [length, mass] : {std::pair(1e3, 1e3), std::pair(1.0 / 0.0254, 1e-3)}) {
    SCOPED_TRACE(length);
    const Largest scaled = largest_forces(in_units(swing(), length, mass), Vec3::UnitZ());
    EXPECT_EQ(scaled.substeps, here.substeps);
    EXPECT_NEAR(scaled.force, here.force * mass * length, 1e-6 * here.force * mass * length);
  }
}

/// Bennett's linkage: four skew hinges, which move only because opposite links have equal lengths
/// and twists, with sin(twist) proportional to the length. Three rows are redundant.
Scene bennett() {
  constexpr double kLength[] = {1.0, 0.7};  // [m]
  const double twist[] = {0.9, std::asin(0.7 * std::sin(0.9))};
  const double first = 0.8;  // angles of the hinges [rad]
  const double ratio =
      std::sin((twist[1] + twist[0]) / 2.0) / std::sin((twist[1] - twist[0]) / 2.0);
  const double second = 2.0 * std::atan(ratio / std::tan(first / 2.0));
  const double angle[] = {first, second, -first, -second};
  Scene scene;
  scene.name = "bennett";
  scene.frame = 1.0 / 60.0;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {1.0, -kGravity, 2.0};
  Quat q = Quat::Identity();
  Vec3 at = Vec3::Zero();
  std::vector<Vec3> point;
  std::vector<Vec3> axis;
  for (std::size_t i = 0; i < 4; ++i) {
    point.push_back(at);
    axis.push_back(q * Vec3::UnitZ());
    q = q * Quat(Eigen::AngleAxisd(angle[i], Vec3::UnitZ()));
    const double half = 0.5 * kLength[i % 2];
    if (i < 3) {
      Body body;
      body.name = "link " + std::to_string(i);
      body.shape = Box{{half, 0.05, 0.1}};
      body.mass = 1.0 + static_cast<double>(i);
      body.inertia = body.mass * Vec3(0.02, 0.08, 0.09);
      body.position = at + q * Vec3(half, 0.0, 0.0);
      body.orientation = q;
      scene.bodies.push_back(body);
    }
    at += q * Vec3(2.0 * half, 0.0, 0.0);
    q = q * Quat(Eigen::AngleAxisd(twist[i % 2], Vec3::UnitX()));
  }
  EXPECT_LT(at.norm(), 1e-12) << "the loop is closed";
  EXPECT_LT((q * Vec3::UnitZ() - axis[0]).norm(), 1e-12);
  const auto join = [&](int a, int b, std::size_t i) {
    HingeJoint joint;
    joint.name = "hinge " + std::to_string(i);
    joint.a = a;
    joint.b = b;
    const auto local = [&](int body, const Vec3& v) -> Vec3 {
      return body == kWorld ? v : scene.bodies[index(body)].orientation.conjugate() * v;
    };
    const auto anchor = [&](int body) {
      return local(body, body == kWorld ? point[i] : point[i] - scene.bodies[index(body)].position);
    };
    joint.anchor_a = anchor(a);
    joint.anchor_b = anchor(b);
    joint.axis_a = local(a, axis[i]);
    joint.axis_b = local(b, axis[i]);
    scene.joints.emplace_back(joint);
  };
  join(0, kWorld, 0);
  join(1, 0, 1);
  join(2, 1, 2);
  join(2, kWorld, 3);
  return scene;
}

std::vector<double> rates_of(const Scene& scene, double seconds) {
  substep::Settings settings;
  settings.watch_stiffness = true;
  std::vector<double> r;
  test::run(
      scene, settings, seconds,
      [&](const Simulator&, const FrameReport& report) { r.push_back(report.r_stiffness); }, false);
  return r;
}

/// r, by which N is chosen, in every frame: the same for the scene turned, in other units, and with
/// another order of bodies, joints and the bodies of joints.
void expect_rates_of_their_own(const Scene& scene, double seconds, double tolerance) {
  SCOPED_TRACE(scene.name);
  ASSERT_TRUE(validate(scene).empty()) << validate(scene)[0].message;
  const std::vector<double> expected = rates_of(scene, seconds);
  const Quat R(Eigen::AngleAxisd(1.3, Vec3(0.3, -0.5, 0.8).normalized()));
  const auto scaled = [&](double mass, double length) {
    Scene other = test::in_units(scene, mass, length);
    other.contact.margin = scene.contact.margin;  // of no contact; it has a largest value
    return other;
  };
  const std::pair<const char*, Scene> others[] = {
      {"turned", test::transformed(scene, R, Vec3::Zero())},
      {"in millimetres and grams", scaled(1e3, 1e3)},
      {"in inches and tonnes", scaled(1e-3, 1.0 / 0.0254)},
      {"reversed", reversed(scene)}};
  for (const auto& [name, other] : others) {
    ASSERT_TRUE(validate(other).empty()) << name << ": " << validate(other)[0].message;
    const std::vector<double> found = rates_of(other, seconds);
    ASSERT_EQ(found.size(), expected.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      keep_largest(largest, std::abs(found[i] - expected[i]) / expected[i]);
    }
    EXPECT_LT(largest, tolerance) << name;
  }
}

// Redundant rows pull at each other by rounding, the more the less they are softened, and the force
// of a loop was shared by the joints that the elimination did not take for a tree: N had noise, and
// changed with the order of the file.
TEST(Loops, RatesDependOnTheMotionAlone) {
  for (const Scene& scene :
       {bennett(), scenes::crank_rocker(), swing(), scenes::exam_bricard().scene}) {
    expect_rates_of_their_own(scene, 1.0, 1e-9);
  }
  // Near its singular pose the forces are nearly undetermined.
  expect_rates_of_their_own(scenes::exam_four_bar().scene, 1.0, 1e-8);
}

// The impulse of a row with bounds is kept, and redundant joints share the rest.
TEST(Loops, RatesWithDryFrictionDependOnTheMotionAlone) {
  Scene scene = bennett();
  std::get<HingeJoint>(scene.joints[1]).friction = 0.3;
  scene.effects.joint_friction = true;
  expect_rates_of_their_own(scene, 0.3, 1e-8);
}

// One redundant row alone took forces that grew with N.
TEST(Loops, ForcesOfBricardsMechanismConverge) {
  const ExamCase exam = exact(scenes::exam_bricard());
  double last = 0.0;
  for (const int n : {8, 16, 32}) {
    Simulator simulator = test::simulator_of(exam.scene, stormer(exam.scene, n));
    double most = 0.0;
    for (int i = 0; i < 500; ++i) {
      simulator.step();
      for (const JointForce& joint : simulator.constraint_forces().joints) {
        most = std::max({most, joint.force.norm(), joint.torque.norm()});
      }
    }
    EXPECT_LT(most, 100.0);
    if (last > 0.0) {
      EXPECT_NEAR(most, last, 0.02 * last);
    }
    last = most;
  }
}

// Contradictory rows: a coupler 1 mm too long for its pins. The error that no impulse can correct
// remains in the bounded pivots, and no correction increases the force.
TEST(Loops, ContradictoryRowsStayBounded) {
  Scene scene = swing();
  base(scene.joints[3]).anchor_a.z() = 1e-3;  // out of the plane, where there is no compliance
  scene.start = StartPolicy::kKeep;
  Simulator simulator = test::simulator_of(scene, stormer(scene, 16));
  for (int i = 0; i < 300; ++i) {
    const FrameReport report = simulator.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    EXPECT_LT(report.joint_gap, 2e-3);
  }
}

}  // namespace
}  // namespace substep
