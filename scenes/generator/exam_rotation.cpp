// Bodies that spin: a heavy top, and free bodies without gravity.

#include <memory>

#include "core/lab/exact_motion.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {
namespace {

// ---- heavy top

/// Its moments about the fixed point: those about the centre, and m L^2 across.
PivotedBody top() {
  return {.mass = 15.0,
          .inertia = {0.234375 + 15.0, 0.46875, 0.234375 + 15.0},
          .centre = {0.0, 1.0, 0.0},
          .gravity = {0.0, 0.0, -9.81}};
}
const Vec3 kTopRate{0.0, 150.0, -4.61538};  // at the start, body and world alike [rad/s]

/// The top's attitude, integrated in steps of at most 10 us; halving them changes it by 1e-11 rad.
class TopMotion {
 public:
  const Attitude& at(double t) {
    constexpr double kLongest = 1e-5;  // [s]
    const int steps = static_cast<int>(std::ceil((t - t_) / kLongest));
    if (steps > 0) attitude_ = pivoted_body_after(top(), attitude_, t - t_, steps);
    t_ = std::max(t, t_);
    return attitude_;
  }

 private:
  double t_ = 0.0;
  Attitude attitude_{Quat::Identity(), kTopRate};
};

ExamMotion top_motion() {
  return [motion = std::make_shared<TopMotion>()](double t, std::vector<Vec3>& x,
                                                  std::vector<Quat>& q) {
    q[0] = motion->at(t).q_WB;
    x[0] = q[0] * top().centre;
  };
}

ExamMeasure measure_top() {
  auto motion = std::make_shared<TopMotion>();
  // Euler parameters, scalar first, after 0.2 s.
  const Quat published = Quat(-0.70828, 0.43878, 0.54573, 0.0894).normalized();
  return [=](const ExamView& view, std::span<double> errors) {
    const State& state = view.state;
    const Quat& q = motion->at(state.time).q_WB;
    raise(errors[0], angle_between(q, state.q[0]));
    raise(errors[1], (state.x[0] - q * top().centre).norm());
    if (state.time > view.scene.criteria.duration - 0.5 * view.scene.frame) {
      errors[2] = 0.5 * angle_between(published, state.q[0]);
    }
  };
}

// ---- free bodies

ExamCase free_body(const std::string& name, const std::string& title, const std::string& definition,
                   const Vec3& extents, const Vec3& inertia, const Vec3& rate) {
  ExamCase exam = exam_case(name, title, definition, "the closed form, from textbooks", 20.0, 0.1);
  Scene& scene = exam.scene;
  scene.effects = {.gyroscopic = true};
  scene.camera.eye = {1.4, 1.0, 2.4};
  scene.camera.target = {0.0, 0.0, 0.0};
  Body body = solid("body", box(extents.x(), extents.y(), extents.z()), 1.0, Vec3::Zero());
  body.inertia = inertia;
  body.angular_velocity = rate;
  scene.bodies.push_back(body);
  scene.criteria.track = 0;
  exam.quantities = {{"orientation", "rad", six_digits(1.0), kSixDigits},
                     {"angular velocity", "rad/s", six_digits(rate.norm()), kSixDigits}};
  exam.methods = exam_methods(scene.settings, {16, 64, 256});
  exam.least_for_order = 1e-9;
  exam.most_for_order = 0.3;
  return exam;
}

const Vec3 kSymmetric{1.0, 1.0, 2.0};      // moments [kg m^2]
const Vec3 kSymmetricRate{1.0, 0.5, 2.0};  // [rad/s]
const Vec3 kUneven{1.0, 2.0, 3.0};         // moments [kg m^2]
constexpr double kMiddleRate = 3.0;        // [rad/s]
constexpr double kAside = 0.03;            // about the axis of the largest moment [rad/s]

}  // namespace

ExamCase exam_heavy_top() {
  ExamCase exam =
      exam_case("heavy_top", "Heavy top at 150 rad/s",
                "A top of 15 kg whose centre is 1 m from its fixed point, spinning at 150 rad/s, "
                "released in a horizontal position.",
                "a benchmark of publications on Lie group integrators, Euler parameters after 0.2 "
                "s to five decimals; and the motion in minimal coordinates, integrated here",
                0.2, 0.01);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = top().gravity;
  scene.camera.eye = {4.0, 0.5, 1.0};
  scene.camera.target = {0.0, 0.5, 0.0};
  Body body = solid("top", box(0.35, 0.35, 0.35), top().mass, top().centre);
  body.inertia = {0.234375, 0.46875, 0.234375};
  body.angular_velocity = kTopRate;
  body.velocity = kTopRate.cross(top().centre);
  scene.bodies.push_back(body);
  BallJoint joint;
  joint.name = "tip";
  joint.anchor_a = -top().centre;
  scene.joints.emplace_back(joint);
  scene.criteria.track = 0;
  exam.quantities = {{"orientation", "rad", 1e-5, "twice the rounding of the Euler parameters"},
                     {"position", "m", 1e-5, "the same at 1 m"},
                     {"Euler parameters", "-", 1e-5, "five decimals are published"}};
  exam.measure = measure_top;
  exam.motion = top_motion;
  exam.methods = exam_methods(scene.settings, {64, 256, 1024});
  exam.least_for_order = 1e-9;
  exam.most_for_order = 0.3;
  return exam;
}

ExamCase exam_symmetric_body() {
  ExamCase exam = free_body("symmetric_body", "Free body with two equal moments",
                            "A plate in free flight rotates and wobbles: its axis precesses about "
                            "the angular momentum at a constant rate.",
                            {1.0, 1.0, 0.1}, kSymmetric, kSymmetricRate);
  exam.measure = [] {
    return [](const ExamView& view, std::span<double> errors) {
      const Attitude exact = free_symmetric_body(
          kSymmetric.x(), kSymmetric.z(), {Quat::Identity(), kSymmetricRate}, view.state.time);
      raise(errors[0], angle_between(exact.q_WB, view.state.q[0]));
      raise(errors[1], (angular_velocity_of(view.state, 0) - exact.w).norm());
    };
  };
  exam.motion = [] {
    return [](double t, std::vector<Vec3>&, std::vector<Quat>& q) {
      q[0] =
          free_symmetric_body(kSymmetric.x(), kSymmetric.z(), {Quat::Identity(), kSymmetricRate}, t)
              .q_WB;
    };
  };
  return exam;
}

ExamCase exam_tumbling() {
  ExamCase exam =
      free_body("tumbling", "Free body about its intermediate axis (Dzhanibekov)",
                "A free block rotates about its intermediate axis and flips over again and again.",
                {1.0, 0.6, 0.2}, kUneven, {0.0, kMiddleRate, kAside});
  exam.measure = [] {
    const auto exact = std::make_shared<ExactTumbling>(kUneven, kMiddleRate, kAside);
    return [exact](const ExamView& view, std::span<double> errors) {
      const Attitude& attitude = exact->at(view.state.time);
      raise(errors[0], angle_between(attitude.q_WB, view.state.q[0]));
      raise(errors[1], (angular_velocity_of(view.state, 0) - attitude.w).norm());
    };
  };
  exam.motion = [] {
    const auto exact = std::make_shared<ExactTumbling>(kUneven, kMiddleRate, kAside);
    return
        [exact](double t, std::vector<Vec3>&, std::vector<Quat>& q) { q[0] = exact->at(t).q_WB; };
  };
  return exam;
}

}  // namespace substep::scenes
