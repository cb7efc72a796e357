// A box that a constant force pulls over the ground, with 25 balls on top that roll: SimBenchmark's
// test of friction. Its numbers are in z-up; here y is up.

#include <vector>

#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_contact.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {
namespace {

constexpr double kRollingGravity = 9.8;
constexpr double kBoxMass = 10.0;       // [kg]
constexpr double kBallMass = 1.0;       // [kg]
constexpr double kRollingRadius = 0.5;  // of a ball [m]
constexpr int kRollingSide = 5;         // balls along a side
constexpr double kForce = 150.0;        // on the box [N]
constexpr double kOnGround = 0.4;       // friction of box on ground [-]
constexpr double kOnBox = 0.8;          // friction of balls on the box [-]

}  // namespace

// The box slides on the ground, f_1 = mu (M + n m) g against the force. Each ball rolls without
// slipping, pulled by f_2:  m a_2 = f_2,  (2/5) m r^2 alpha = f_2 r,  a_1 = a_2 + r alpha = 3.5
// f_2/m. With M a_1 = F - f_1 - n f_2:
//   f_2 = (F - f_1)/M / (3.5/m + n/M).
RollingAccelerations rolling_accelerations() {
  constexpr int n = kRollingSide * kRollingSide;
  const double sliding = kOnGround * (kBoxMass + n * kBallMass) * kRollingGravity;
  const double on_ball = (kForce - sliding) / kBoxMass / (3.5 / kBallMass + n / kBoxMass);
  return {(kForce - sliding - n * on_ball) / kBoxMass, on_ball / kBallMass};
}

namespace {

ExamMeasure measure_rolling(const Vec3& along) {
  const RollingAccelerations exact = rolling_accelerations();
  double sum = 0.0;
  int samples = 0;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    const State& state = view.state;
    const Vec3 box_off = velocity_of(state, 1) - exact.box * state.time * along;
    const Vec3 ball_off = velocity_of(state, 2) - exact.ball * state.time * along;
    sum += box_off.squaredNorm() + ball_off.squaredNorm();
    ++samples;
    errors[0] = sum / samples;
  };
}

/// A ball on the box rolls with the difference between the box's speed and its own.
ExamMotion rolling_motion(const Scene& scene, const Vec3& along) {
  std::vector<Vec3> start;
  for (const Body& body : scene.bodies) start.push_back(body.position);
  return [=](double t, std::vector<Vec3>& x, std::vector<Quat>& q) {
    const RollingAccelerations exact = rolling_accelerations();
    const double half = 0.5 * t * t;
    x[1] = start[1] + half * exact.box * along;
    const Vec3 axis = along.cross(Vec3::UnitY());
    for (std::size_t i = 2; i < x.size(); ++i) {
      x[i] = start[i] + half * exact.ball * along;
      q[i] = Eigen::AngleAxisd(half * (exact.box - exact.ball) / kRollingRadius, axis);
    }
  };
}

ExamCase rolling(const std::string& name, const std::string& title, const Vec3& along,
                 FrictionCone cone) {
  ExamCase exam = exam_case(name, title,
                            "A force of 150 N pulls a box of 10 kg over the ground; 25 balls on "
                            "it roll without slipping.",
                            "SimBenchmark, its closed form", 4.0, 0.016);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .contact = true, .friction = true};
  scene.effects.external = true;
  scene.gravity = {0.0, -kRollingGravity, 0.0};
  scene.settings.friction_cone = cone;
  scene.camera.eye = {14.0, 9.0, 18.0};
  scene.camera.target = {0.0, 0.5, 0.0};
  // The coefficient of a pair is the geometric mean of the bodies' coefficients.
  scene.bodies.push_back(floor_plane());
  scene.bodies.back().friction = kOnGround * kOnGround / kOnBox;
  Body slab = solid("slab", box(20.0, 1.0, 20.0), kBoxMass, {0.0, 0.5, 0.0});
  slab.friction = kOnBox;
  slab.force = kForce * along;
  scene.bodies.push_back(slab);
  for (int i = 0; i < kRollingSide; ++i) {
    for (int j = 0; j < kRollingSide; ++j) {
      Body ball = solid("ball_" + std::to_string(kRollingSide * i + j + 1), Sphere{kRollingRadius},
                        kBallMass, {2.0 * i - 4.0, 1.0 + kRollingRadius, 2.0 * j - 4.0});
      ball.friction = kOnBox;
      scene.bodies.push_back(ball);
    }
  }
  scene.criteria.track = 1;
  exam.quantities = {
      {"mean square velocity error", "m^2/s^2", 4.1e-7,
       "RaiSim's published figure at 1 ms; those of the other engines range from 1e-17 to 3"}};
  exam.measure = [along] { return measure_rolling(along); };
  exam.motion = [scene, along] { return rolling_motion(scene, along); };
  exam.methods = contact_methods(scene.settings, {4, 16, 64});  // 16: their step of 1 ms
  return exam;
}

}  // namespace

ExamCase exam_rolling() {
  return rolling("rolling", "SimBenchmark, rolling along an axis", {0.0, 0.0, 1.0},
                 FrictionCone::kBox);
}

ExamCase exam_rolling_oblique() {
  return rolling("rolling_oblique", "SimBenchmark, rolling at 60 degrees to an axis",
                 {0.5, 0.0, 0.866025403784439}, FrictionCone::kCone);
}

}  // namespace substep::scenes
