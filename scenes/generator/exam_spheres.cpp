// Spheres without friction: SimBenchmark's tests of impacts and of hard contacts.

#include "core/math/random.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_contact.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {
namespace {

constexpr double kSphereMass = 10.0;   // [kg]
constexpr double kSphereRadius = 0.1;  // [m]

// ---- bouncing: 49 balls fall from the same height and lose no energy. They move alike and do
//      not meet, so that one of them gives the sum.

constexpr int kSphereCount = 49;
constexpr double kSphereHeight = 5.0;  // of their centres at the start [m]

ExamMeasure measure_energy(double at_start, double factor) {
  double sum = 0.0;
  int samples = 0;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    const double off = factor * (view.report.energy - at_start);
    sum += off * off;
    ++samples;
    errors[0] = sum / samples;
  };
}

// ---- 666: six by six by six spheres fall and spread.

constexpr int kSphereSide = 6;
constexpr double kSphereGap = 0.21;     // between centres [m]
constexpr double kLowest = 1.101;       // centre of the lowest layer [m]
constexpr double kPerturbation = 1e-3;  // [m]

Scene& add_spheres(Scene& scene, double restitution) {
  Random random(42);
  const auto aside = [&] { return kPerturbation * 0.5 * (1.0 + random.next()); };
  scene.bodies.push_back(floor_plane());
  for (int i = 0; i < kSphereSide * kSphereSide * kSphereSide; ++i) {
    const Eigen::Vector3i cell(i % kSphereSide, i / kSphereSide % kSphereSide,
                               i / (kSphereSide * kSphereSide));
    Vec3 at = kSphereGap * cell.cast<double>() + Vec3(0.0, kLowest, 0.0);
    for (int axis = 0; axis < 3; ++axis) at[axis] += aside();
    Body ball = solid("ball_" + std::to_string(i + 1), Sphere{kSphereRadius}, kSphereMass, at);
    ball.restitution = restitution;
    scene.bodies.push_back(ball);
  }
  scene.criteria.track = 1;
  scene.camera.eye = {3.0, 2.5, 4.5};
  scene.camera.target = {0.5, 0.8, 0.5};
  return scene;
}

/// Sum of the squares of all overlaps, as the source has it [m^2].
double squared_overlaps(const State& state) {
  double sum = 0.0;
  for (std::size_t i = 1; i < state.x.size(); ++i) {
    const double into_ground = std::max(0.0, kSphereRadius - state.x[i].y());
    sum += into_ground * into_ground;
    for (std::size_t j = i + 1; j < state.x.size(); ++j) {
      const double squared = (state.x[i] - state.x[j]).squaredNorm();
      if (squared >= 4.0 * kSphereRadius * kSphereRadius) continue;
      const double overlap = 2.0 * kSphereRadius - std::sqrt(squared);
      sum += overlap * overlap;
    }
  }
  return sum;
}

/// Steps of 4 and 1 ms. Without the methods of fourth order: they gain nothing between impacts,
/// where spheres fall freely, and each of their runs takes seconds.
std::vector<ExamMethod> sphere_methods(const Settings& base) {
  std::vector<ExamMethod> methods = contact_methods(base, {4, 16});
  std::erase_if(methods, [](const ExamMethod& method) {
    return method.name == "stormer" || method.name == "newton numerov";
  });
  return methods;
}

ExamMeasure measure_overlaps() {
  double sum = 0.0;
  int samples = 0;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    sum += squared_overlaps(view.state);
    ++samples;
    errors[0] = sum / samples;
  };
}

}  // namespace

ExamCase exam_bouncing() {
  ExamCase exam = exam_case("bouncing", "SimBenchmark, bouncing",
                            "A ball of 10 kg falls 4.9 m and bounces for 20 s without loss.",
                            "SimBenchmark: constant energy; its 49 balls move alike", 20.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .contact = true, .restitution = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  scene.contact.compliance = 1e-16;  // compliance at an impact takes away speed
  scene.camera.eye = {0.0, 2.5, 10.0};
  scene.camera.target = {0.0, 2.5, 0.0};
  scene.bodies.push_back(floor_plane());
  Body ball = solid("ball", Sphere{kSphereRadius}, kSphereMass, {0.0, kSphereHeight, 0.0});
  ball.restitution = 1.0;
  scene.bodies.push_back(ball);
  scene.criteria.track = 1;
  exam.quantities = {{"mean square energy error", "J^2", 0.0186,
                      "RaiSim's published figure at 1 ms, the best; ODE has 185, Bullet 75,000"}};
  exam.measure = [] {
    return measure_energy(kSphereMass * kExamGravity * kSphereHeight, kSphereCount);
  };
  exam.motion = [] {
    return [](double t, std::vector<Vec3>& x, std::vector<Quat>&) {
      const double fall = std::sqrt(2.0 * (kSphereHeight - kSphereRadius) / kExamGravity);  // [s]
      const double since_top = std::remainder(t, 2.0 * fall);
      x[1].y() = kSphereHeight - 0.5 * kExamGravity * since_top * since_top;
    };
  };
  exam.methods = contact_methods(scene.settings, {10, 25, 100});  // 10, 4 and 1 ms
  return exam;
}

ExamCase exam_spheres() {
  ExamCase exam = exam_case(
      "spheres_666", "SimBenchmark, 666 spheres",
      "216 spheres of 10 kg, 6 x 6 x 6 of them, fall 1 m and spread without friction. Slow in the "
      "window: a frame has hundreds of contacts and several sub-steps.",
      "SimBenchmark's measure, over the first 2 s, which contain all impacts", 2.0, 0.016);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .contact = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  add_spheres(scene, 0.0);
  exam.quantities = {{"mean squared overlaps", "m^2", 1.35e-4,
                      "RaiSim's published figure at 1 ms, the best; ODE has 1.5e-4, DART 2.8e-4, "
                      "MuJoCo 0.1, Bullet 0.4"}};
  exam.measure = measure_overlaps;
  exam.methods = sphere_methods(scene.settings);
  return exam;
}

ExamCase exam_elastic_spheres() {
  ExamCase exam =
      exam_case("elastic_666", "SimBenchmark, elastic 666 spheres",
                "The same spheres with elastic impacts: they fly apart. Slow in the window, as the "
                "other.",
                "SimBenchmark: constant energy, over the first 2 s", 2.0, 0.016);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .contact = true, .restitution = true};
  scene.gravity = {0.0, -kExamGravity, 0.0};
  scene.contact.compliance = 1e-16;
  scene.contact.restitution_speed = 0.0;
  // The distance by which two spheres approach in 4 ms: contacts detected late are pushed apart.
  scene.contact.margin = 0.05;
  add_spheres(scene, 1.0);
  double energy = 0.0;
  for (const Body& body : scene.bodies) {
    if (!body.is_static) energy += body.mass * kExamGravity * body.position.y();
  }
  exam.quantities = {{"mean square energy error", "J^2", 8.4,
                      "RaiSim's published figure at 1 ms, the best; ODE has 112, Bullet 41,000"}};
  exam.measure = [energy] { return measure_energy(energy, 1.0); };
  exam.methods = sphere_methods(scene.settings);
  return exam;
}

}  // namespace substep::scenes
