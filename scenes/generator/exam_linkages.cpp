// Closed loops of hinges with one degree of freedom: IFToMM A02 and A04.

#include <array>
#include <memory>

#include "core/lab/exact_motion.hpp"
#include "scenes/generator/bricard.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {
namespace {

/// Both loops have redundant hinge rows: six in the planar four-bar, one in Bricard's mechanism.
/// They are exact: a compliance of 1e-16 m/N, which would distribute the force among them, causes
/// an error of 3e-6 m when the four-bar passes its singular pose.
HingeJoint hinge(const std::string& name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b,
                 const Vec3& axis) {
  HingeJoint joint;
  joint.name = name;
  joint.a = a;
  joint.b = b;
  joint.anchor_a = anchor_a;
  joint.anchor_b = anchor_b;
  joint.axis_a = axis;  // bodies start along the world's axes
  joint.axis_b = axis;
  return joint;
}

/// A thin uniform rod of 1 kg and 1 m along an axis of the world.
Body rod(const std::string& name, int axis, const Vec3& centre) {
  constexpr double kWidth = 0.04;  // drawn [m]
  Vec3 extents = Vec3::Constant(kWidth);
  extents[axis] = 1.0;
  Body body = solid(name, box(extents.x(), extents.y(), extents.z()), 1.0, centre);
  body.inertia = Vec3::Constant(1.0 / 12.0);
  body.inertia[axis] = 1e-4;  // it never rotates about its length
  return body;
}

// ---- A02. The three uprights rotate together, by theta from the vertical, and the two horizontal
//      rods follow without rotation: (3 (1/3) + 2) theta'' = (3/2 + 2) g sin theta.

ExactPendulum four_bar_turn() {
  return ExactPendulum::over_the_top(std::sqrt(3.5 * kExamGravity / 3.0), 1.0);
}

ExamMotion four_bar_motion() {
  return [exact = four_bar_turn()](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
    const double from_top = exact.at(t).angle - std::numbers::pi;
    const Vec3 upright{std::sin(from_top), std::cos(from_top), 0.0};
    for (int i = 0; i < 3; ++i) {
      x[index(i)] = Vec3(i, 0.0, 0.0) + 0.5 * upright;
      q[index(i)] = Eigen::AngleAxisd(-from_top, Vec3::UnitZ());
    }
    for (int i = 0; i < 2; ++i) x[index(3 + i)] = Vec3(i + 0.5, 0.0, 0.0) + upright;
  };
}

ExamMeasure measure_four_bar() {
  const ExactPendulum exact = four_bar_turn();
  const Vec3 top_B{0.0, 0.5, 0.0};
  const Vec3 published{0.32845811154, 0.94451853818, 0.0};  // after 10 s
  const Vec3 velocity{1.42305147020, -0.49486884548, 0.0};
  return [=](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    const Vec3 arm = state.q[0] * top_B;
    const Vec3 B0 = state.x[0] + arm;
    const double from_top = exact.at(state.time).angle - std::numbers::pi;
    raise(errors[0], (B0 - Vec3(std::sin(from_top), std::cos(from_top), 0.0)).norm());
    if (state.time > view.scene.criteria.duration - 0.5 * view.scene.frame) {
      errors[1] = (B0 - published).norm();
      const Vec3 v = velocity_of(state, 0) + angular_velocity_of(state, 0).cross(arm);
      errors[2] = (v - velocity).norm();
    }
  };
}

// ---- A04

ExamMotion bricard_motion() {
  return
      [motion = std::make_shared<Bricard>()](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
        motion->advance(t);
        for (int i = 0; i < Bricard::kRods; ++i) {
          x[index(i)] = motion->centre(i);
          q[index(i)] = motion->orientation(i);
        }
      };
}

ExamMeasure measure_bricard(double frame) {
  auto motion = std::make_shared<Bricard>();
  double start_energy = 0.0;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    const State& state = view.state;
    motion->advance(frame * static_cast<double>(state.frame));
    for (int i = 0; i < Bricard::kRods; ++i) {
      raise(errors[0], (state.x[index(i)] - motion->centre(i)).norm());
    }
    if (state.frame == 0) start_energy = view.report.energy;
    raise(errors[1], std::abs(view.report.energy - start_energy));
  };
}

}  // namespace

ExamCase exam_four_bar() {
  ExamCase exam = exam_case(
      "four_bar", "IFToMM A02, double four-bar",
      "Five rods of 1 kg and 1 m on seven hinges, upright, pushed at 1 m/s; twice per revolution "
      "all of them lie in one line, a singular pose.",
      "IFToMM benchmark, the first corner after 10 s; and the closed form by elliptic functions",
      10.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  scene.camera.eye = {1.0, 0.5, 6.0};
  scene.camera.target = {1.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    Body body = rod("upright_" + std::to_string(i), 1, {static_cast<double>(i), 0.5, 0.0});
    body.velocity = {0.5, 0.0, 0.0};
    body.angular_velocity = {0.0, 0.0, -1.0};
    scene.bodies.push_back(body);
  }
  for (int i = 0; i < 2; ++i) {
    Body body = rod("across_" + std::to_string(i), 0, {i + 0.5, 1.0, 0.0});
    body.velocity = {1.0, 0.0, 0.0};
    scene.bodies.push_back(body);
  }
  const Vec3 up{0.0, 0.5, 0.0};
  const Vec3 right{0.5, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    scene.joints.emplace_back(hinge("ground_" + std::to_string(i), i, -up, kWorld,
                                    {static_cast<double>(i), 0.0, 0.0}, Vec3::UnitZ()));
  }
  scene.joints.emplace_back(hinge("corner_0", 0, up, 3, -right, Vec3::UnitZ()));
  scene.joints.emplace_back(hinge("corner_1", 1, up, 3, right, Vec3::UnitZ()));
  scene.joints.emplace_back(hinge("corner_2", 1, up, 4, -right, Vec3::UnitZ()));
  scene.joints.emplace_back(hinge("corner_3", 2, up, 4, right, Vec3::UnitZ()));
  scene.criteria.track = 0;
  const char* why = "an independent code extrapolates to the same within 2e-8";
  exam.quantities = {{"exact position", "m", six_digits(1.0), kSixDigits},
                     {"position after 10 s", "m", 2e-8, why},
                     {"velocity after 10 s", "m/s", 1e-7, "2e-8 m at the 5 rad/s of the motion"}};
  exam.measure = measure_four_bar;
  exam.motion = four_bar_motion;
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-8;
  exam.most_for_order = 0.1;
  return exam;
}

ExamCase exam_bricard() {
  ExamCase exam = exam_case(
      "bricard", "IFToMM A04, Bricard's mechanism",
      "Five rods of 1 kg and 1 m along the edges of a cube on six hinges, released at rest: "
      "overconstrained, yet mobile.",
      "IFToMM benchmark: constant energy; its motion is integrated here in minimal coordinates",
      10.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  scene.camera.eye = {3.0, 1.5, 4.0};
  scene.camera.target = {0.5, -0.5, 0.5};
  for (int i = 0; i < Bricard::kRods; ++i) {
    const Vec3 along = Bricard::point(i + 1) - Bricard::point(i);
    const Vec3 extents = along.cwiseAbs() + 0.1 * (Vec3::Ones() - along.cwiseAbs());
    scene.bodies.push_back(solid("rod_" + std::to_string(i + 1),
                                 box(extents.x(), extents.y(), extents.z()), 1.0,
                                 0.5 * (Bricard::point(i) + Bricard::point(i + 1))));
  }
  for (int i = 0; i <= Bricard::kRods; ++i) {
    const Vec3 P = Bricard::point(i);
    const int a = std::min(i, Bricard::kRods - 1);
    const int b = i == 0 || i == Bricard::kRods ? kWorld : i - 1;
    const Vec3 anchor_b = b == kWorld ? P : Vec3(P - scene.bodies[index(b)].position);
    scene.joints.emplace_back(hinge("hinge_" + std::to_string(i + 1), a,
                                    P - scene.bodies[index(a)].position, b, anchor_b,
                                    Bricard::axis(i)));
  }
  scene.criteria.track = 2;
  exam.quantities = {
      {"exact position", "m", six_digits(1.0), kSixDigits},
      {"energy", "J", 1e-3, "the source requires no drift; a swing exchanges 4.6 J"}};
  exam.measure = [frame = scene.frame] { return measure_bricard(frame); };
  exam.motion = bricard_motion;
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-8;
  exam.most_for_order = 0.1;
  return exam;
}

}  // namespace substep::scenes
