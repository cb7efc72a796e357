// Random invalid scenes and states, generated from a seed: for any input the simulator returns a
// status and reads nothing out of bounds, which the preset sanitizers checks.

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"
#include "tests/unit/support.hpp"

namespace substep {
namespace {

constexpr int kInputs = 1000;

int whole_number(test::Random& random, int least, int most) {
  return std::uniform_int_distribution<int>(least, most)(random);
}

double any_number(test::Random& random) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double odd[] = {0.0,   -0.0,   -1.0,      1e-300,     1e300,
                        -1e30, 1e-320, kInfinite, -kInfinite, std::nan("")};
  const int which = whole_number(random, 0, 14);
  return which < 10 ? odd[which] : test::uniform(random, -10.0, 10.0);
}

int any_index(test::Random& random) {
  const int odd[] = {-5, -2, -1, 0, 1, 77, 99, 1 << 30, -(1 << 30), 1000};
  return odd[whole_number(random, 0, 9)];
}

Vec3 any_vector(test::Random& random) {
  return {any_number(random), any_number(random), any_number(random)};
}

/// A row of bodies, each joined to the previous one, some of them static; in half of the scenes.
Scene some_scene(test::Random& random) {
  Scene scene;
  scene.effects = {
      .gravity = true, .gyroscopic = true, .joints = true, .contact = true, .friction = true};
  const int count = whole_number(random, 0, 6);
  for (int i = 0; i < count; ++i) {
    Body body = whole_number(random, 0, 3) == 0 ? test::fixed(Box{}) : test::moving(Sphere{0.4});
    body.position = {1.0 * i, 0.0, 0.0};
    scene.bodies.push_back(body);
    if (i == 0 || body.is_static) continue;
    HingeJoint joint;
    joint.a = i;
    joint.b = i - 1;
    joint.anchor_a.x() = -0.5;
    joint.anchor_b.x() = 0.5;
    if (whole_number(random, 0, 1) == 0) {
      scene.joints.emplace_back(joint);
    } else {
      scene.joints.emplace_back(test::ball_of(joint));
    }
  }
  return scene;
}

void spoil_body(test::Random& random, Body& body) {
  switch (whole_number(random, 0, 6)) {
    case 0:
      body.mass = any_number(random);
      break;
    case 1:
      body.inertia = any_vector(random);
      break;
    case 2:
      body.position = any_vector(random);
      break;
    case 3:
      body.velocity = any_vector(random);
      break;
    case 4:
      body.orientation.coeffs()[whole_number(random, 0, 3)] = any_number(random);
      break;
    case 5:
      body.shape = Sphere{any_number(random)};
      break;
    default:
      body.shape = Plane{};
      break;
  }
}

void spoil_joint(test::Random& random, Joint& joint) {
  JointBase& j = base(joint);
  switch (whole_number(random, 0, 4)) {
    case 0:
      j.a = any_index(random);
      break;
    case 1:
      j.b = any_index(random);
      break;
    case 2:
      j.b = j.a;
      break;
    case 3:
      j.anchor_a = any_vector(random);
      break;
    default:
      j.compliance = any_number(random);
      break;
  }
}

void spoil_settings(test::Random& random, Settings& settings) {
  switch (whole_number(random, 0, 6)) {
    case 0:
      settings.alpha = any_number(random);
      break;
    case 1:
      settings.solver = static_cast<SolverKind>(whole_number(random, 0, 9));
      break;
    case 2:
      settings.mode = static_cast<Mode>(whole_number(random, 0, 12));
      break;
    case 3:
      settings.n = whole_number(random, -3, 3);
      break;
    case 4:
      settings.memory = any_number(random);
      break;
    case 5:
      settings.hold = whole_number(random, -3, 3);
      break;
    default:
      settings.drift_tau = any_number(random);
      break;
  }
}

void spoil(test::Random& random, Scene& scene) {
  const int what = whole_number(random, 0, 5);
  if (what == 0 && !scene.bodies.empty()) {
    spoil_body(
        random,
        scene.bodies[index(whole_number(random, 0, static_cast<int>(scene.bodies.size()) - 1))]);
  } else if (what <= 2 && !scene.joints.empty()) {
    spoil_joint(
        random,
        scene.joints[index(whole_number(random, 0, static_cast<int>(scene.joints.size()) - 1))]);
  } else if (what == 3) {
    spoil_settings(random, scene.settings);
  } else if (what == 4) {
    scene.frame = any_number(random);
    scene.criteria.track = any_index(random);
  } else {
    scene.carried = Carried{};
    scene.carried->k.resize(index(whole_number(random, 0, 9)), Vec6::Zero());
    scene.carried->u.resize(index(whole_number(random, 0, 9)), Vec6::Zero());
  }
}

void spoil(test::Random& random, State& state) {
  const auto size = index(whole_number(random, 0, 9));
  switch (whole_number(random, 0, 11)) {
    case 0:
      state = State{};
      break;
    case 1:
      state.x.resize(size, Vec3::Zero());
      break;
    case 2:
      state.q.resize(size, Quat::Identity());
      break;
    case 3:
      state.u.resize(size, Vec6::Zero());
      break;
    case 4:
      state.k.resize(size, Vec6::Zero());
      break;
    case 5:
      state.own.resize(size);
      break;
    case 6:
      state.rest.resize(size);
      break;
    case 7:
      state.acceleration.resize(size, Vec6::Zero());
      break;
    case 8:
      state.dt_previous = any_number(random);
      break;
    case 9:
      state.held.resize(size);
      break;
    case 10:
      state.held_frames = whole_number(random, -3, 3);
      break;
    default:
      state.torque.resize(size, Vec3::Zero());
      break;
  }
}

/// Calls every query of a simulator. @return its last status
StepStatus ask_all(test::Random& random, Simulator& simulator) {
  FrameReport report = simulator.step();
  report = simulator.observe();
  EXPECT_LE(simulator.constraint_forces().joints.size(), simulator.scene().joints.size());
  Grab grab;
  grab.body = any_index(random);
  grab.target = any_vector(random);
  simulator.set_grab(grab);
  simulator.substep();
  Settings settings = simulator.settings();
  spoil_settings(random, settings);
  simulator.set_settings(settings);
  simulator.substep();
  State state = simulator.state();
  spoil(random, state);
  simulator.set_state(state);
  report = simulator.step();
  simulator.reset();
  return report.status;
}

TEST(InvalidInput, AThousandRandomScenesAndStatesReadNothingOutOfBounds) {
  test::Random random(31);
  int refused = 0;
  int stepped = 0;
  for (int i = 0; i < kInputs; ++i) {
    Scene scene = some_scene(random);
    const int broken = whole_number(random, 0, 2);
    for (int k = 0; k < broken; ++k) spoil(random, scene);
    const bool sound = check_values(scene).empty();
    Simulator simulator(std::make_shared<const Scene>(scene));
    EXPECT_EQ(simulator.problems().empty(), sound) << i;
    EXPECT_EQ(simulator.observe().status == StepStatus::kInvalid, !sound) << i;
    (sound ? stepped : refused) += 1;
    const StepStatus status = ask_all(random, simulator);
    if (!sound) {
      EXPECT_EQ(status, StepStatus::kInvalid) << i;
    }
  }
  EXPECT_GT(refused, 300);  // otherwise one of the two would be under-tested
  EXPECT_GT(stepped, 300);
}

}  // namespace
}  // namespace substep
