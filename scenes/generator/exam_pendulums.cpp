// Planar pendulums and a fall along an axis: one of the IFToMM benchmark, the others with results
// of a commercial multibody code.

#include <array>

#include "core/lab/exact_motion.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_parts.hpp"
#include "scenes/generator/exam_tables.hpp"

namespace substep::scenes {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;

// ---- IFToMM A01. The point mass is a ball whose centre of oscillation is 1 m from the hinge:
//      with I about the centre and a the centre's distance, I + m a^2 = m a L, the rigid body moves
//      as the point mass at L does. This avoids the limit of a body without inertia.

constexpr double kPendulumLength = 1.0;                           // L [m]
constexpr double kBallRadius = 0.05;                              // [m]
constexpr double kBallInertia = 0.4 * kBallRadius * kBallRadius;  // of 1 kg [kg m^2]

double centre_distance() {
  return 0.5 *
         (kPendulumLength + std::sqrt(kPendulumLength * kPendulumLength - 4.0 * kBallInertia));
}

ExamMeasure measure_simple_pendulum() {
  const ExactPendulum exact =
      ExactPendulum::released(std::sqrt(kExamGravity / kPendulumLength), kRightAngle);
  const Vec3 P_B{centre_distance() - kPendulumLength, 0.0, 0.0};
  const Vec3 published{-0.27508746258, -0.96141920510, 0.0};  // after 10 s
  return [=](const ExamView& view, std::span<double> errors) {
    const Vec3 P = view.state.x[0] + view.state.q[0] * P_B;
    const double angle = exact.at(view.state.time).angle;
    raise(errors[0], (P - Vec3(-std::sin(angle), -std::cos(angle), 0.0)).norm());
    if (view.state.time > view.scene.criteria.duration - 0.5 * view.scene.frame) {
      errors[1] = (P - published).norm();
    }
  };
}

ExamMotion simple_pendulum_motion() {
  const ExactPendulum exact =
      ExactPendulum::released(std::sqrt(kExamGravity / kPendulumLength), kRightAngle);
  return [exact](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
    const double angle = exact.at(t).angle;
    x[0] = -centre_distance() * Vec3(std::sin(angle), std::cos(angle), 0.0);
    q[0] = Eigen::AngleAxisd(kRightAngle - angle, Vec3::UnitZ());
  };
}

// ---- The commercial code's rows: 1 kg, centre 2 m from the joint along the body's x, released
//      from (2, 0, 0), gravity along -z. It turns about +y from x to -z.

constexpr double kArm = 2.0;  // [m]
constexpr double kTableGravity = 9.80665;
const Vec3 kInertia{0.04, 0.1, 0.1};  // about the centre [kg m^2]

ExactPendulum table_swing() {
  const double about_joint = kInertia.y() + kArm * kArm;
  return ExactPendulum::released(std::sqrt(kArm * kTableGravity / about_joint), kRightAngle);
}

ExamMotion table_motion() {
  return [exact = table_swing()](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
    const double angle = exact.at(t).angle;
    x[0] = kArm * Vec3(std::sin(angle), 0.0, -std::cos(angle));
    q[0] = Eigen::AngleAxisd(kRightAngle - angle, Vec3::UnitY());
  };
}

struct TableTolerance {
  double position;     // [m]
  double velocity;     // [m/s]
  double orientation;  // [rad]
  double rate;         // [rad/s]
  double force;        // [N]
};

template <std::size_t n>
ExamMeasure measure_table(const std::array<PendulumRow, n>& rows) {
  const ExactPendulum exact = table_swing();
  const auto orientation = [](const PendulumRow& row) {
    return Quat(row.e0, row.e1, row.e2, row.e3).normalized();
  };
  return [&rows, exact, orientation](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    const double angle = exact.at(state.time).angle;
    raise(errors[0], (state.x[0] - kArm * Vec3(std::sin(angle), 0.0, -std::cos(angle))).norm());
    const auto i = static_cast<std::size_t>(std::lround(state.time / 0.1));
    if (i >= rows.size() || view.forces.joints.empty()) return;
    const PendulumRow& row = rows[i];
    raise(errors[1], (state.x[0] - Vec3(row.x, 0.0, row.z)).norm());
    raise(errors[2], (velocity_of(state, 0) - Vec3(row.vx, 0.0, row.vz)).norm());
    // The markers of that code have other axes, so rotations since the start are compared.
    const Quat turned = orientation(row) * orientation(rows[0]).conjugate();
    raise(errors[3], angle_between(state.q[0], turned));
    raise(errors[4], (angular_velocity_of(state, 0) - Vec3(0.0, row.wy, 0.0)).norm());
    const Vec3 on_body = view.forces.joints[0].force.cast<double>();
    raise(errors[5], (-on_body - Vec3(row.fx, 0.0, row.fz)).norm());
  };
}

ExactPendulum rod_swing() {
  return ExactPendulum::released(std::sqrt(kTableGravity / kArm), kRightAngle);
}

Vec3 rod_end(double angle) { return kArm * Vec3(0.0, std::sin(angle), -std::cos(angle)); }

ExamMeasure measure_rod() {
  return [exact = rod_swing()](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    raise(errors[0], (state.x[0] - rod_end(exact.at(state.time).angle)).norm());
    const auto i = static_cast<std::size_t>(std::lround(state.time / 0.1));
    if (i >= kRodRows.size() || view.forces.joints.empty()) return;
    const RodRow& row = kRodRows[i];
    raise(errors[1], (state.x[0] - Vec3(0.0, row.y, row.z)).norm());
    raise(errors[2], (velocity_of(state, 0) - Vec3(0.0, row.vy, row.vz)).norm());
    raise(errors[3], angle_between(state.q[0], Quat::Identity()));
    const Vec3 on_body = view.forces.joints[0].force.cast<double>();
    raise(errors[4], (-on_body - Vec3(0.0, row.fy, row.fz)).norm());
  };
}

// The same swing about -x, from (0, 2, 0): the moment about the joint is that of the other tables.
ExamMeasure measure_universal() {
  const auto orientation = [](const CrossRow& row) {
    return Quat(row.e0, row.e1, row.e2, row.e3).normalized();
  };
  return [exact = table_swing(), orientation](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    raise(errors[0], (state.x[0] - rod_end(exact.at(state.time).angle)).norm());
    const auto i = static_cast<std::size_t>(std::lround(state.time / 0.1));
    if (i >= kUniversalRows.size() || view.forces.joints.empty()) return;
    const CrossRow& row = kUniversalRows[i];
    raise(errors[1], (state.x[0] - Vec3(0.0, row.y, row.z)).norm());
    raise(errors[2], (velocity_of(state, 0) - Vec3(0.0, row.vy, row.vz)).norm());
    raise(errors[3], angle_between(state.q[0], orientation(row)));
    raise(errors[4], (angular_velocity_of(state, 0) - Vec3(row.wx, 0.0, 0.0)).norm());
    const Vec3 on_body = view.forces.joints[0].force.cast<double>();
    raise(errors[5], (-on_body - Vec3(0.0, row.fy, row.fz)).norm());
  };
}

ExamMotion universal_motion() {
  return [exact = table_swing()](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
    const double angle = exact.at(t).angle;
    x[0] = rod_end(angle);
    q[0] = Eigen::AngleAxisd(angle, Vec3::UnitX());
  };
}

Vec3 fallen(double t) { return {kArm, 0.0, -0.5 * kTableGravity * t * t}; }

ExamMeasure measure_cylindrical() {
  return [](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    raise(errors[0], (state.x[0] - fallen(state.time)).norm());
    const auto i = static_cast<std::size_t>(std::lround(state.time / 0.1));
    if (i >= kCylindricalRows.size() || view.forces.joints.empty()) return;
    const FallRow& row = kCylindricalRows[i];
    raise(errors[1], (state.x[0] - Vec3(kArm, 0.0, row.z)).norm());
    raise(errors[2], (velocity_of(state, 0) - Vec3(0.0, 0.0, row.vz)).norm());
    raise(errors[3], angle_between(state.q[0], Quat::Identity()));
    raise(errors[4], view.forces.joints[0].force.cast<double>().norm());
  };
}

ExamCase table_case(const std::string& name, const std::string& title,
                    const TableTolerance& tolerance, const std::string& why) {
  ExamCase exam = exam_case(
      name, title,
      "A body of 1 kg whose centre is 2 m from the joint, released at rest from the horizontal.",
      "a table computed with a commercial multibody code, published as a joint benchmark; and the "
      "closed form by "
      "elliptic functions",
      5.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, 0.0, -kTableGravity};
  scene.camera.eye = {1.0, -8.0, 1.0};
  scene.camera.target = {0.0, 0.0, -1.0};
  Body body = solid("body", box(0.6, 0.4, 0.4), 1.0, {kArm, 0.0, 0.0});
  body.inertia = kInertia;
  scene.bodies.push_back(body);
  scene.criteria.track = 0;
  exam.quantities = {{"exact position", "m", six_digits(kArm), kSixDigits},
                     {"position", "m", tolerance.position, why},
                     {"velocity", "m/s", tolerance.velocity, why},
                     {"orientation", "rad", tolerance.orientation, why},
                     {"angular velocity", "rad/s", tolerance.rate, why},
                     {"reaction force", "N", tolerance.force, why}};
  exam.needs_forces = true;
  exam.motion = table_motion;
  exam.least_for_order = 1e-9;
  exam.most_for_order = 0.1;
  return exam;
}

}  // namespace

ExamCase exam_simple_pendulum() {
  ExamCase exam =
      exam_case("simple_pendulum", "IFToMM A01, simple pendulum",
                "A point mass of 1 kg, 1 m from a hinge, released at rest from the horizontal.",
                "IFToMM benchmark, the point after 10 s; and the closed form by elliptic functions",
                10.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  scene.camera.eye = {0.0, 0.0, 4.0};
  scene.camera.target = {0.0, -0.5, 0.0};
  Body ball = solid("ball", Sphere{kBallRadius}, 1.0, {-centre_distance(), 0.0, 0.0});
  scene.bodies.push_back(ball);
  HingeJoint hinge;
  hinge.name = "hinge";
  hinge.anchor_a = {centre_distance(), 0.0, 0.0};
  scene.joints.emplace_back(hinge);
  scene.criteria.track = 0;
  exam.quantities = {{"exact position", "m", six_digits(kPendulumLength), kSixDigits},
                     {"position after 10 s", "m", 1e-10,
                      "eleven decimals are published; sub-steps add rounding errors"}};
  exam.measure = measure_simple_pendulum;
  exam.motion = simple_pendulum_motion;
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 2e-11;
  exam.most_for_order = 0.1;
  return exam;
}

ExamCase exam_revolute() {
  ExamCase exam =
      table_case("revolute", "Revolute joint, commercial code", {1e-5, 1e-5, 4e-6, 1e-5, 1e-3},
                 "the table's own distance from the closed form, over all 501 rows");
  HingeJoint hinge;
  hinge.name = "revolute";
  hinge.anchor_a = {-kArm, 0.0, 0.0};
  hinge.axis_a = Vec3::UnitY();
  hinge.axis_b = Vec3::UnitY();
  exam.scene.joints.emplace_back(hinge);
  exam.measure = [] { return measure_table(kRevoluteRows); };
  exam.methods = exam_methods(exam.scene.settings, {16, 64, 256});
  return exam;
}

ExamCase exam_spherical() {
  ExamCase exam = table_case(
      "spherical", "Spherical joint, commercial code", {1e-3, 3e-3, 5e-4, 1.2e-3, 1.4e-2},
      "the table's own distance from the closed form, over all 501 rows: a hundred times that of "
      "the revolute joint's table, although the motion is the same");
  BallJoint joint;
  joint.name = "spherical";
  joint.anchor_a = {-kArm, 0.0, 0.0};
  exam.scene.joints.emplace_back(joint);
  exam.measure = [] { return measure_table(kSphericalRows); };
  exam.methods = exam_methods(exam.scene.settings, {16, 64, 256});
  return exam;
}

ExamCase exam_universal() {
  ExamCase exam = table_case(
      "universal", "Universal joint, commercial code", {1e-3, 3e-3, 5e-4, 1.2e-3, 1.4e-2},
      "the table's own distance from the closed form, over all 501 rows: like that of the "
      "spherical joint's table");
  Body& body = exam.scene.bodies[0];
  body.shape = box(0.4, 0.4, 0.6);
  body.inertia = {0.1, 0.1, 0.04};
  body.position = {0.0, kArm, 0.0};
  body.orientation = Eigen::AngleAxisd(kRightAngle, Vec3::UnitX());
  exam.scene.camera.eye = {8.0, 1.0, 1.0};
  UniversalJoint joint;
  joint.name = "universal";
  joint.anchor_a = {0.0, 0.0, kArm};
  joint.axis_a = Vec3::UnitY();
  joint.axis_b = Vec3::UnitX();
  exam.scene.joints.emplace_back(joint);
  exam.measure = measure_universal;
  exam.motion = universal_motion;
  exam.methods = exam_methods(exam.scene.settings, {16, 64, 256});
  return exam;
}

ExamCase exam_cylindrical() {
  const std::string why = "the table has six digits, of up to 123 m and 49 m/s";
  ExamCase exam = exam_case(
      "cylindrical", "Cylindrical joint, commercial code",
      "A body of 1 kg that turns about and slides along a vertical axis, 2 m from its centre, "
      "released at rest; it falls.",
      "a table computed with a commercial multibody code, published as a joint benchmark; "
      "and the closed form",
      5.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, 0.0, -kTableGravity};
  scene.camera.eye = {1.0, -8.0, 1.0};
  scene.camera.target = {0.0, 0.0, -1.0};
  Body body = solid("body", box(0.6, 0.4, 0.4), 1.0, {kArm, 0.0, 0.0});
  body.inertia = kInertia;
  scene.bodies.push_back(body);
  CylindricalJoint joint;
  joint.name = "cylindrical";
  joint.anchor_a = {-kArm, 0.0, 0.0};
  scene.joints.emplace_back(joint);
  scene.criteria.track = 0;
  exam.quantities = {{"exact position", "m", six_digits(kArm), kSixDigits},
                     {"position", "m", 5e-4, why},
                     {"velocity", "m/s", 6e-5, why},
                     {"orientation", "rad", 1e-12, "it does not rotate"},
                     {"reaction force", "N", 1e-9, "no force acts across the axis"}};
  exam.needs_forces = true;
  exam.measure = measure_cylindrical;
  exam.motion = [] {
    return [](double t, std::vector<Vec3>& x, std::vector<Quat>&) { x[0] = fallen(t); };
  };
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-9;
  exam.most_for_order = 0.1;
  return exam;
}

ExamCase exam_distance() {
  const std::string why = "the table's own distance from the closed form, over all 501 rows";
  ExamCase exam = exam_case(
      "distance", "Distance joint, commercial code",
      "A body of 1 kg whose centre hangs on a rod of 2 m without mass, "
      "released at rest from the horizontal; it does not rotate.",
      "a table computed with a commercial multibody code, published as a joint benchmark; "
      "and the closed form by elliptic functions",
      5.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, 0.0, -kTableGravity};
  scene.camera.eye = {8.0, 1.0, 1.0};
  scene.camera.target = {0.0, 0.0, -1.0};
  Body body = solid("body", box(0.4, 0.6, 0.4), 1.0, {0.0, kArm, 0.0});
  body.inertia = kInertia;
  scene.bodies.push_back(body);
  DistanceJoint rod;
  rod.name = "rod";
  rod.length = kArm;
  scene.joints.emplace_back(rod);
  scene.criteria.track = 0;
  exam.quantities = {{"exact position", "m", six_digits(kArm), kSixDigits},
                     {"position", "m", 1e-6, why},
                     {"velocity", "m/s", 1e-6, why},
                     {"orientation", "rad", 1e-12, "the rod acts at the centre"},
                     {"reaction force", "N", 2e-3, why}};
  exam.needs_forces = true;
  exam.measure = measure_rod;
  exam.motion = [] {
    return [exact = rod_swing()](double t, std::vector<Vec3>& x, std::vector<Quat>&) {
      x[0] = rod_end(exact.at(t).angle);
    };
  };
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-9;
  exam.most_for_order = 0.1;
  return exam;
}

}  // namespace substep::scenes
