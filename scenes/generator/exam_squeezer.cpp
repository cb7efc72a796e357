// IFToMM A03, Andrews' squeezing mechanism: seven bodies, ten hinges in a plane, a spring, and a
// crank that a constant torque turns 2.5 times in 0.03 s.

#include <array>
#include <cmath>
#include <string>

#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {
namespace {
namespace andrews {

constexpr double kRate = 4530.0;         // of the spring [N/m]
constexpr double kFreeLength = 0.07785;  // [m]
constexpr double kDrive = 0.033;         // [N m]
constexpr double kEnd = 0.03;            // [s]

constexpr int kBodies = 7;
constexpr std::array<double, kBodies> kMass{0.04325, 0.00365, 0.02373, 0.00706,
                                            0.07050, 0.00706, 0.05498};  // [kg]
constexpr std::array<double, kBodies> kInertiaZ{2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7,
                                                1.169e-5, 5.667e-7, 1.912e-5};  // [kg m^2]

/// Seven angles [rad].
struct Angles {
  double beta, theta, gamma, phi, delta, omega, epsilon;
};
constexpr Angles kStart{-0.0617138900142764496358948458001, 0.0,
                        0.455279819163070380255912382449,   0.222668390165885884674473185609,
                        0.487364979543842550225598953530,   -0.222668390165885884674473185609,
                        1.23054744454982119249735015568};
// The reference solution at the end, and its rates [rad/s].
constexpr Angles kAtEnd{15.81077119629904,   -15.75637105984298, 0.04082224013073101,
                        -0.5347301163226948, 0.5244099658805304, 0.5347301163226948,
                        1.048080741042263};
constexpr Angles kRateAtEnd{1139.920302151208, -1424.379294994111, 11.03291221937134,
                            19.29337464421385, 0.5735699284790808, -19.29337464421385,
                            0.3231791658026955};

Vec3 along(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }
Vec3 across_of(double angle) { return {std::sin(angle), -std::cos(angle), 0.0}; }

/// Sums of the angles that rotate each body.
std::array<double, kBodies> turns(const Angles& q) {
  return {q.beta,  q.beta + q.theta,    q.gamma,  q.phi + q.delta,
          q.delta, q.omega + q.epsilon, q.epsilon};
}

/// Poses of the mechanism. The lengths have the names of the test set [m].
struct Squeezer {
  static constexpr double rr = 0.007;  // crank
  static constexpr double d = 0.028;   // from the crank's pin to P
  static constexpr double e = 0.02;    // from P to the end of the upper lever
  static constexpr double zf = 0.02;   // from P to the end of the lower lever
  static constexpr double zt = 0.04;   // upper lever
  static constexpr double u = 0.04;    // lower lever
  static constexpr double sc = 0.018;  // of the spring's point on the triangle
  static constexpr double sd = 0.02;
  // Centres of mass.
  static constexpr double ra = 0.00092;
  static constexpr double da = 0.0115;
  static constexpr double sa = 0.01874;
  static constexpr double sb = 0.01043;
  static constexpr double ea = 0.01421;
  static constexpr double fa = 0.01421;
  static constexpr double ta = 0.02308;
  static constexpr double tb = 0.00916;
  static constexpr double ua = 0.01228;
  static constexpr double ub = 0.00449;
  // Points of the ground.
  Vec3 A{-0.06934, -0.00227, 0.0};
  Vec3 B{-0.03635, 0.03273, 0.0};
  Vec3 C{0.014, 0.072, 0.0};

  explicit Squeezer(const Angles& q);

  std::array<Vec3, kBodies> centre;   // [m]
  std::array<double, kBodies> angle;  // of rotation, in the same order for rates [rad]
  Vec3 pin, P, upper, lower, spring;  // end of the crank, ends of the levers, end of the spring
};

Squeezer::Squeezer(const Angles& q) : angle(turns(q)) {
  const auto& [crank, rod, triangle, third, lever, fourth, last] = angle;
  pin = rr * along(crank);
  P = pin - d * along(rod);
  upper = A + zt * along(lever);
  lower = A + u * across_of(last);
  spring = B + sc * across_of(triangle) + sd * along(triangle);
  centre = {ra * along(crank),
            pin - da * along(rod),
            B + sa * across_of(triangle) + sb * along(triangle),
            upper + (e - ea) * across_of(third),
            A + ta * along(lever) - tb * across_of(lever),
            lower + (zf - fa) * along(fourth),
            A + ua * across_of(last) - ub * along(last)};
}

ExamMeasure measure_squeezer() {
  const Squeezer start(kStart);
  const Squeezer end(kAtEnd);
  return [=](const ExamView& view, std::span<double> errors) {
    if (view.state.time < kEnd - 0.5 * view.scene.frame) return;
    const std::array<double, kBodies> rates = turns(kRateAtEnd);
    for (int i = 0; i < kBodies; ++i) {
      raise(errors[0], (view.state.x[index(i)] - end.centre[index(i)]).norm());
      const double turned = end.angle[index(i)] - start.angle[index(i)];
      raise(errors[1],
            angle_between(view.state.q[index(i)], Quat(Eigen::AngleAxisd(turned, Vec3::UnitZ()))));
      raise(errors[2],
            (angular_velocity_of(view.state, i) - Vec3(0.0, 0.0, rates[index(i)])).norm());
    }
  };
}

}  // namespace andrews
}  // namespace

ExamCase exam_squeezer() {
  using namespace andrews;
  ExamCase exam = exam_case("squeezer", "IFToMM A03, Andrews' squeezing mechanism",
                            "Seven bodies of a few grams on ten hinges, a spring, and a constant "
                            "torque on the crank.",
                            "the test set for initial value problems: all angles and their rates "
                            "after 0.03 s",
                            kEnd, 0.001);
  Scene& scene = exam.scene;
  scene.effects = {.gyroscopic = true, .joints = true, .external = true};
  scene.gravity.setZero();
  scene.camera.eye = {-0.03, 0.03, 0.25};
  scene.camera.target = {-0.03, 0.03, 0.0};
  const Squeezer at(kStart);
  const char* names[] = {"crank",       "rod",        "triangle",   "upper link",
                         "upper lever", "lower link", "lower lever"};
  for (int i = 0; i < kBodies; ++i) {
    Body body = solid(names[i], box(0.01, 0.004, 0.002), kMass[index(i)], at.centre[index(i)]);
    body.inertia = Vec3::Constant(kInertiaZ[index(i)]);
    scene.bodies.push_back(body);
  }
  scene.bodies[0].torque = {0.0, 0.0, kDrive};
  const auto join = [&](const std::string& name, int a, int b, const Vec3& point) {
    HingeJoint hinge;
    hinge.name = name;
    hinge.a = a;
    hinge.b = b;
    hinge.anchor_a = point - at.centre[index(a)];
    hinge.anchor_b = b == kWorld ? point : Vec3(point - at.centre[index(b)]);
    scene.joints.emplace_back(hinge);
  };
  join("O", 0, kWorld, Vec3::Zero());
  join("pin", 1, 0, at.pin);
  join("B", 2, kWorld, at.B);
  join("upper A", 4, kWorld, at.A);
  join("lower A", 6, kWorld, at.A);
  join("upper end", 3, 4, at.upper);
  join("lower end", 5, 6, at.lower);
  join("P triangle", 1, 2, at.P);
  join("P upper", 1, 3, at.P);
  join("P lower", 1, 5, at.P);
  DistanceJoint spring;
  spring.name = "spring";
  spring.a = 2;
  spring.anchor_a = at.spring - at.centre[2];
  spring.anchor_b = at.C;
  spring.length = kFreeLength;
  spring.compliance = 1.0 / kRate;
  scene.joints.emplace_back(spring);
  scene.criteria.track = 0;
  exam.quantities = {
      {"position after 0.03 s", "m", six_digits(Squeezer::zt), kSixDigits},
      {"orientation after 0.03 s", "rad", 1e-4, "six digits of the crank's 16 rad, rounded up"},
      {"angular velocity after 0.03 s", "rad/s", 1e-2, "six digits of the rod's 1,400 rad/s"}};
  exam.measure = measure_squeezer;
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-10;
  exam.most_for_order = 1e-3;
  return exam;
}

}  // namespace substep::scenes
