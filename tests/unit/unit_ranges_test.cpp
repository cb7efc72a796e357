// The ranges of the format hide no unit: what is allowed in metres and kilograms is allowed in the
// units of other trades.

#include <gtest/gtest.h>

#include <string>

#include "core/model/scene_builder.hpp"
#include "core/model/validate.hpp"
#include "tests/support/placed.hpp"

namespace substep::test {
namespace {

struct Units {
  const char* name;
  double per_kilogram;
  double per_metre;
};

constexpr Units kUnits[] = {{"m, kg", 1.0, 1.0},           {"mm, kg", 1.0, 1e3},
                            {"mm, g", 1e3, 1e3},           {"mm, t", 1e-3, 1e3},
                            {"m, t", 1e-3, 1.0},           {"inch, t", 1e-3, 1.0 / 0.0254},
                            {"inch, lb", 2.2046, 39.3701}, {"cm, g", 1e3, 1e2}};

/// A machine with every kind of joint and all that a coordinate can have, of a given size, mass,
/// largest speed and force.
Scene machine(double size, double mass, double speed, double force) {
  SceneBuilder builder("machine");
  Scene& scene = builder.scene();
  scene.gravity = {0.0, 0.0, -25.0};  // Jupiter's
  scene.contact.margin = size;
  scene.contact.restitution_speed = speed;
  scene.contact.compliance = 1.0 / force;
  scene.contact.friction_compliance = 1.0 / force;
  scene.contact.soft_compliance = 1.0 / force;
  scene.regularisation = 1.0 / mass;
  const double torque = force * size;
  for (int i = 0; i < 8; ++i) {
    builder.add_body(Box{{size, 0.5 * size, 0.2 * size}}, mass, {3.0 * i * size, 0.0, size});
    Body& body = builder.body(i);
    body.velocity = {speed, 0.0, 0.0};
    body.angular_velocity = {0.0, 0.0, speed / size};
    body.force = {force, 0.0, 0.0};
    body.torque = {0.0, torque, 0.0};
  }
  const auto between = [&](int i) { return Vec3{3.0 * (i + 0.5) * size, 0.0, size}; };
  builder.add_ball_joint(0, 1, between(0));
  const int hinge = builder.add_hinge(1, 2, between(1), Vec3::UnitX());
  const int slide = builder.add_prismatic(2, 3, between(2), Vec3::UnitX());
  builder.add_universal(3, 4, between(3), Vec3::UnitX(), Vec3::UnitY());
  builder.add_cylindrical(4, 5, between(4), Vec3::UnitX());
  builder.add_weld(5, 6, between(5));
  for (Joint& joint : scene.joints) {
    base(joint).compliance = size / force;
    std::visit(
        [&](auto& of) {
          if constexpr (requires { of.angular_compliance; }) of.angular_compliance = 1.0 / torque;
        },
        joint);
  }
  for (const int joint : {hinge, slide}) {
    const bool slides = joint == slide;
    const double effort = slides ? force : torque;
    const double unit = slides ? size : 1.0;
    const double rate = slides ? speed : speed / size;
    builder.rub(joint, effort);
    builder.add_armature(joint, mass * (slides ? 1.0 : size * size));
    builder.add_spring(joint, {0.0, effort / unit, effort / rate});
    builder.drive(joint, Drive{0.0, rate, effort / unit, effort / rate, effort});
  }
  builder.add_rope(6, 7, between(6), between(6) + Vec3(size, 0.0, 0.0), 2.0 * size);
  return *builder.build();
}

TEST(UnitRanges, OfAMachineOfTwoGramsAndOfTenThousandTonsAllowEveryUnit) {
  struct Case {
    const char* name;
    Scene scene;
  };
  for (const Case& of :
       {Case{"watch", machine(1e-4, 1e-6, 1.0, 1e-7)}, Case{"toy", machine(0.01, 0.002, 3.0, 0.02)},
        Case{"soft toy", machine(0.01, 0.002, 3.0, 1e-9)},
        Case{"car", machine(2.0, 2000.0, 100.0, 1e5)},
        Case{"shell", machine(0.1, 10.0, 2000.0, 1e6)},
        Case{"crane", machine(30.0, 1e7, 10.0, 1e9)}}) {
    for (const Units& units : kUnits) {
      for (const Problem& problem :
           check_values(in_units(of.scene, units.per_kilogram, units.per_metre))) {
        ADD_FAILURE() << of.name << " in " << units.name << ": " << to_string(problem);
      }
    }
  }
}

}  // namespace
}  // namespace substep::test
