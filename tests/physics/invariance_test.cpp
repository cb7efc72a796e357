// What must not change the motion.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"
#include "tests/support/tumbling_chain.hpp"

namespace substep::test {
namespace {

struct Case {
  std::string name;
  Scene scene;
  double seconds;    // short enough that rounding has not grown
  double tolerance;  // on the tracked body [m]
};

std::vector<Case> cases() {
  return {{"swinging_box", scenes::swinging_box(), 5.0, 1e-6},
          {"bridge", scenes::bridge(), 0.5, 1e-5},
          {"heavy_stack_stress", scenes::heavy_stack_stress(), 1.0, 1e-7}};
}

/// @param place where the tracked body of `b` must be, from where that of `a` is
void expect_same(const Case& c, const Outcome& a, const Outcome& b,
                 const std::function<Vec3(const Vec3&)>& place) {
  ASSERT_EQ(a.n, b.n) << c.name;
  ASSERT_EQ(a.track.size(), b.track.size());
  for (std::size_t i = 0; i < a.track.size(); ++i) {
    ASSERT_LE((place(a.track[i]) - b.track[i]).norm(), c.tolerance) << c.name << " frame " << i;
  }
}

void expect_same(const Case& c, const Outcome& a, const Outcome& b, const Quat& R, const Vec3& by) {
  expect_same(c, a, b, [&](const Vec3& x) -> Vec3 { return R * x + by; });
}

TEST(Invariance, AKilometreAwaySubstepsAndMotionAreTheSame) {
  const Vec3 by{1000.0, -300.0, 700.0};
  for (const Case& c : cases()) {
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    const Outcome there =
        run(transformed(c.scene, Quat::Identity(), by), c.scene.settings, c.seconds);
    expect_same(c, here, there, Quat::Identity(), by);
  }
}

TEST(Invariance, TurnedWithGravitySubstepsAndMotionAreTheSame) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.3, -0.5, 0.8)}) {
    const Quat R(Eigen::AngleAxisd(1.1, axis.normalized()));
    for (const Case& c : cases()) {
      const Outcome here = run(c.scene, c.scene.settings, c.seconds);
      const Outcome turned =
          run(transformed(c.scene, R, Vec3::Zero()), c.scene.settings, c.seconds);
      expect_same(c, here, turned, R, Vec3::Zero());
    }
  }
}

/// The image in the plane x = 0. Body frames are mirrored too, so that shapes and moments stay:
/// R' = S R S with S = diag(-1, 1, 1), and angular velocities, being axial, turn the other way.
Scene mirrored(Scene scene) {
  const auto polar = [](Vec3& v) { v.x() = -v.x(); };
  const auto axial = [](Vec3& v) { v = {v.x(), -v.y(), -v.z()}; };
  polar(scene.gravity);
  for (Body& body : scene.bodies) {
    polar(body.position);
    polar(body.velocity);
    axial(body.angular_velocity);
    const Quat& q = body.orientation;
    body.orientation = Quat(q.w(), q.x(), -q.y(), -q.z());
  }
  for (Joint& joint : scene.joints) {
    polar(base(joint).anchor_a);
    polar(base(joint).anchor_b);
    auto* hinge = std::get_if<HingeJoint>(&joint);
    if (hinge == nullptr) continue;
    polar(hinge->axis_a);
    polar(hinge->axis_b);
  }
  return scene;
}

Vec3 mirrored(const Vec3& x) { return {-x.x(), x.y(), x.z()}; }

TEST(Invariance, AMirroredSceneMovesAsItsImage) {
  for (const Case& c : cases()) {
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    const Outcome there = run(mirrored(c.scene), c.scene.settings, c.seconds);
    expect_same(c, here, there, [](const Vec3& x) { return mirrored(x); });
  }
}

/// The same scene in other units: masses times `mass`, lengths times `length`, times times `time`.
/// A compliance is a length per force (time^2 / mass), an angular one an angle per torque.
Scene in_units(Scene scene, double mass, double length, double time) {
  const double speed = length / time;
  const double compliance = time * time / mass;
  scene.frame *= time;
  scene.gravity *= length / (time * time);
  scene.contact.compliance *= compliance;
  scene.contact.friction_compliance *= compliance;
  scene.contact.margin *= length;
  scene.contact.restitution_speed *= speed;
  scene.regularisation /= mass;
  scene.settings.drift_tau *= time;
  Criteria criteria;
  criteria.duration = scene.criteria.duration;
  criteria.joint_gap = scene.criteria.joint_gap * length;
  criteria.track = scene.criteria.track;
  scene.criteria = criteria;
  for (Body& body : scene.bodies) {
    if (auto* sphere = std::get_if<Sphere>(&body.shape)) sphere->radius *= length;
    if (auto* box = std::get_if<Box>(&body.shape)) box->half_extents *= length;
    body.mass *= mass;
    body.inertia *= mass * length * length;
    body.position *= length;
    body.velocity *= speed;
    body.angular_velocity /= time;
  }
  for (Joint& joint : scene.joints) {
    base(joint).anchor_a *= length;
    base(joint).anchor_b *= length;
    base(joint).compliance *= compliance;
    if (auto* hinge = std::get_if<HingeJoint>(&joint)) {
      hinge->angular_compliance *= compliance / (length * length);
    }
  }
  return scene;
}

// Units that are powers of 4 shift exponents only, under square roots too: where no constant of the
// code has a unit the motion is the same to the last bit. The pivoting tolerance of contacts (an
// impulse) and the lengths by which box faces are preferred have one; there it is the same up to
// the growth of rounding.
TEST(Invariance, TheUnitOfMassDoesNotMatter) {
  for (Case c : cases()) {
    if (!c.scene.effects.contact) c.tolerance = 0.0;
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    for (const double unit : {1.0 / 1024.0, 1024.0}) {
      const Scene scene = in_units(c.scene, unit, 1.0, 1.0);
      expect_same(c, here, run(scene, scene.settings, c.seconds), [](const Vec3& x) { return x; });
    }
  }
}

TEST(Invariance, TheUnitsOfLengthAndTimeDoNotMatter) {
  struct Units {
    double length;
    double time;
  };
  for (Case c : cases()) {
    c.scene.regularisation = 0.0;  // the same number on rows in 1/kg and in 1/(kg m^2)
    const bool joints_only = !c.scene.effects.contact;
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    // As large as a house at a stable's pace, and the two apart.
    for (const Units u : {Units{16.0, 4.0}, Units{0.25, 1.0}, Units{1.0, 0.25}}) {
      const Scene scene = in_units(c.scene, 1.0, u.length, u.time);
      Case scaled = c;
      scaled.tolerance = joints_only ? 0.0 : c.tolerance * u.length;
      expect_same(scaled, here, run(scene, scene.settings, c.seconds * u.time),
                  [&](const Vec3& x) -> Vec3 { return u.length * x; });
    }
  }
}

/// The same bodies and joints in another order.
Scene shuffled(const Scene& scene, unsigned seed, bool joints_too) {
  std::vector<int> from(scene.bodies.size());  // new index -> old index
  std::iota(from.begin(), from.end(), 0);
  std::mt19937 random(seed);
  std::shuffle(from.begin(), from.end(), random);
  Scene out = scene;
  std::vector<int> to(from.size());  // old index -> new index
  for (std::size_t i = 0; i < from.size(); ++i) {
    out.bodies[i] = scene.bodies[static_cast<std::size_t>(from[i])];
    to[static_cast<std::size_t>(from[i])] = static_cast<int>(i);
  }
  const auto moved_to = [&](int body) {
    return body == kWorld ? kWorld : to[static_cast<std::size_t>(body)];
  };
  for (Joint& joint : out.joints) {
    base(joint).a = moved_to(base(joint).a);
    base(joint).b = moved_to(base(joint).b);
  }
  if (joints_too) std::shuffle(out.joints.begin(), out.joints.end(), random);
  if (out.criteria.track) out.criteria.track = moved_to(*out.criteria.track);
  if (out.criteria.displacement) {
    out.criteria.displacement->body = moved_to(out.criteria.displacement->body);
  }
  return out;
}

TEST(Invariance, TheOrderOfBodiesAndJointsDoesNotMatterToTheDirectSolver) {
  for (const Case& c : cases()) {
    const Outcome here = run(c.scene, c.scene.settings, c.seconds);
    for (const unsigned seed : {1U, 2U, 3U}) {
      const Scene other = shuffled(c.scene, seed, true);
      expect_same(c, here, run(other, other.settings, c.seconds), Quat::Identity(), Vec3::Zero());
    }
  }
}

// Gauss-Seidel goes by the order of the rows: with the joints' order the last bit stays as well.
TEST(Invariance, TheOrderOfBodiesDoesNotMatterToGaussSeidel) {
  Case c = cases()[0];
  c.tolerance = 0.0;
  c.scene.settings.solver = SolverKind::kPgs;
  const Outcome here = run(c.scene, c.scene.settings, c.seconds);
  for (const unsigned seed : {1U, 2U}) {
    const Scene other = shuffled(c.scene, seed, false);
    expect_same(c, here, run(other, other.settings, c.seconds), Quat::Identity(), Vec3::Zero());
  }
}

// The tangents of friction are built from the body's axes: whatever mu is, a box that is pushed
// slides the same way in a scene that is turned, moved, mirrored or in other units.
TEST(Invariance, FrictionFromNoneToTwoHasNoPreferredDirectionHandOrUnit) {
  const Quat R(Eigen::AngleAxisd(0.7, Vec3(0.2, 1.0, -0.4).normalized()));
  const Vec3 by{10.0, -20.0, 30.0};
  for (const double mu : {0.0, 0.2, 0.5, 1.0, 1.5, 2.0}) {
    // Rounding of 1e-16 in the gap is a force of 1e-16 m / 1e-10 m/N and more, dt^2 of which moves
    // the box; 60 frames add up. The Coulomb force itself has no growing mode.
    Case c{"mu = " + std::to_string(mu), scenes::sliding_box({.friction = mu}), 1.0, 1e-9};
    for (Body& body : c.scene.bodies) {
      if (!body.is_static) body.velocity = {0.5, 0.0, 1.0};
    }
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      c.scene.settings.solver = solver;
      c.name = "mu = " + std::to_string(mu) + (solver == SolverKind::kBpp ? " bpp" : " pgs");
      const auto seen = [&](const Scene& scene, double time = 1.0) {
        return run(scene, scene.settings, time * c.seconds);
      };
      const Outcome here = seen(c.scene);
      expect_same(c, here, seen(transformed(c.scene, R, by)), R, by);
      // A mirrored box has its corners in another order, which Gauss-Seidel goes by.
      if (solver == SolverKind::kBpp) {
        expect_same(c, here, seen(mirrored(c.scene)), [](const Vec3& x) { return mirrored(x); });
      }
      expect_same(c, here, seen(in_units(c.scene, 64.0, 1.0, 1.0)), Quat::Identity(), Vec3::Zero());
      expect_same(c, here, seen(in_units(c.scene, 1.0, 4.0, 2.0), 2.0),
                  [](const Vec3& x) -> Vec3 { return 4.0 * x; });
    }
  }
}

TEST(Invariance, ASnapshotGoesOnBitForBit) {
  for (const Scene& scene :
       {scenes::swinging_box(), scenes::bridge(), scenes::heavy_stack_stress()}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
        const auto shared = std::make_shared<const Scene>(scene);
        Settings settings = scene.settings;
        settings.solver = solver;
        settings.policy = policy;
        settings.warm_start = true;
        Simulator whole(shared);
        whole.set_settings(settings);
        for (int i = 0; i < 40; ++i) whole.step();
        Simulator rest(shared);
        rest.set_settings(settings);
        rest.set_state(whole.state());
        for (int i = 0; i < 40; ++i) {
          whole.step();
          rest.step();
          ASSERT_EQ(state_hash(whole.state()), state_hash(rest.state())) << scene.name << " " << i;
        }
      }
    }
  }
}

/// The scene as it is now, written to a file and read again.
std::shared_ptr<const Scene> through_a_file(const Simulator& simulator) {
  const Scene saved = saved_scene(simulator.scene(), simulator.state(), simulator.settings());
  SceneResult read = read_scene(write_scene(saved));
  for (const Problem& problem : read.problems) ADD_FAILURE() << to_string(problem);
  return read.scene;
}

void expect_same_motion(const State& a, const State& b) {
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    ASSERT_EQ(a.x[i], b.x[i]) << i;
    ASSERT_EQ(a.q[i].coeffs(), b.q[i].coeffs()) << i;
    ASSERT_EQ(a.u[i], b.u[i]) << i;
  }
}

// With forces, stiffness and the last sub-step: what N, the bounds of friction, warm starts and the
// kicks of leapfrog go by.
TEST(Invariance, ARunGoesOnFromASceneFileBitForBit) {
  for (const Scene& scene : scenes::shipped()) {
    const auto shared = std::make_shared<const Scene>(scene);
    const bool small = scene.bodies.size() < 40;
    for (const Mode mode : small ? std::vector{Mode::kConst, Mode::kAdaptive, Mode::kStiffness}
                                 : std::vector{Mode::kAdaptive}) {
      for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
        for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
          SCOPED_TRACE(scene.name + " " + std::string(name_of(mode)) + " " +
                       std::string(name_of(solver)) + " " + std::string(name_of(integrator)));
          Settings settings = own_settings(scene);
          settings.mode = mode;
          settings.solver = solver;
          settings.integrator = integrator;
          settings.warm_start = solver == SolverKind::kPgs;
          settings.refinements = 2;  // of the stress stacks
          settings.detection =
              integrator == Integrator::kEuler ? Detection::kSubstep : Detection::kFrame;
          settings.islands = integrator == Integrator::kLeapfrog;
          settings.sleep = settings.islands;
          settings.n_max = 16;
          Simulator whole(shared);
          whole.set_settings(settings);
          FrameReport last;
          for (int i = 0; i < 30; ++i) last = whole.step();
          if (last.status != StepStatus::kOk) continue;  // within a frame, and not between two
          if (last.joint_gap > 0.09) continue;  // torn: no file may start with joints that far open
          const auto saved = through_a_file(whole);
          ASSERT_NE(saved, nullptr);
          Simulator rest(saved);
          expect_same_motion(whole.state(), rest.state());
          for (int i = 0; i < 15; ++i) {
            const FrameReport a = whole.step();
            const FrameReport b = rest.step();
            ASSERT_EQ(a.n_substeps, b.n_substeps) << i;
            expect_same_motion(whole.state(), rest.state());
          }
        }
      }
    }
  }
}

/// A method that goes on from more than forces and velocities.
struct Carrying {
  std::string name;
  Scene scene;
  void (*choose)(Settings&);
  bool (*carries)(const State&);  // whether what it goes on with is there
};

// Numerov's forces go on with their rates, and its velocities with the accelerations.
Carrying by_numerov(Scene scene) {
  return {"Numerov", std::move(scene),
          [](Settings& settings) {
            settings.solver = SolverKind::kNewton;
            settings.forces = Forces::kNumerov;
            settings.integrator = Integrator::kLeapfrog;
            settings.mode = Mode::kConst;
            settings.n = 16;
            settings.iterations = 1;
          },
          [](const State& state) {
            return !state.acceleration.empty() && state.forces.front().rate_change[0] != 0.0;
          }};
}

Carrying by_stormer(Scene scene) {
  return {"Stormer", std::move(scene),
          [](Settings& settings) { settings.integrator = Integrator::kStormer; },
          [](const State& state) {
            return !state.acceleration_change.empty() &&
                   !state.acceleration_change.back().isZero(0.0);
          }};
}

class WhatIsCarried : public testing::TestWithParam<Carrying> {};

INSTANTIATE_TEST_SUITE_P(Invariance, WhatIsCarried,
                         testing::Values(by_numerov(scenes::swinging_box()),
                                         by_numerov(scenes::bridge()),
                                         by_stormer(scenes::swinging_box())),
                         [](const auto& of) { return of.param.name + "_" + of.param.scene.name; });

TEST_P(WhatIsCarried, GoesOnFromASceneFileBitForBit) {
  const auto& [name, scene, choose, carries] = GetParam();
  Settings settings = own_settings(scene);
  choose(settings);
  Simulator whole(std::make_shared<const Scene>(scene));
  whole.set_settings(settings);
  for (int i = 0; i < 30; ++i) whole.step();
  ASSERT_TRUE(carries(whole.state()));
  const auto saved = through_a_file(whole);
  ASSERT_NE(saved, nullptr);
  Simulator rest(saved);
  for (int i = 0; i < 15; ++i) {
    whole.step();
    rest.step();
    expect_same_motion(whole.state(), rest.state());
  }
}

TEST(Invariance, AnotherLoadOrStartIsNoRunThatGoesOn) {
  Simulator simulator(std::make_shared<const Scene>(scenes::swinging_box()));
  for (int i = 0; i < 3; ++i) simulator.step();
  const Scene saved = saved_scene(simulator.scene(), simulator.state(), simulator.settings());
  EXPECT_TRUE(start_of(saved, 1.0, 0).carried.has_value());
  EXPECT_FALSE(start_of(saved, 2.0, 0).carried.has_value());
  EXPECT_FALSE(start_of(saved, 1.0, 7).carried.has_value());
}

TEST(Invariance, ResetIsTheStart) {
  const auto shared = std::make_shared<const Scene>(scenes::bridge());
  Simulator simulator(shared);
  for (int i = 0; i < 30; ++i) simulator.step();
  const std::uint64_t once = state_hash(simulator.state());
  simulator.reset();
  for (int i = 0; i < 30; ++i) simulator.step();
  EXPECT_EQ(state_hash(simulator.state()), once);
}

struct Momentum {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
};

Momentum momentum_of(const Scene& scene, const State& state) {
  Momentum sum;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Vec6& u = state.u_synchronised[i];
    const Mat3 R = state.q[i].toRotationMatrix();
    sum.linear += body.mass * u.head<3>();
    sum.angular += body.mass * state.x[i].cross(u.head<3>()) +
                   R * body.inertia.cwiseProduct(R.transpose() * u.tail<3>());
  }
  return sum;
}

TEST(Invariance, AFreeChainKeepsItsMomentum) {
  Scene scene = tumbling_chain();
  const auto worst = [&](SolverKind solver, int n) {
    Settings settings;
    settings.solver = solver;
    settings.mode = Mode::kConst;
    settings.n = n;
    settings.integrator = Integrator::kLeapfrog;
    const Momentum start = momentum_of(scene, initial_state(scene));
    Momentum drift;
    run(scene, settings, 5.0, [&](const Simulator& simulator, const FrameReport&) {
      const Momentum now = momentum_of(scene, simulator.state());
      drift.linear = drift.linear.cwiseMax((now.linear - start.linear).cwiseAbs());
      drift.angular = drift.angular.cwiseMax((now.angular - start.angular).cwiseAbs());
    });
    drift.linear /= start.linear.norm();
    drift.angular /= start.angular.norm();
    return drift;
  };
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    EXPECT_LT(worst(solver, 8).linear.norm(), 1e-12);
  }
  // The forces of a joint act at two points phi apart (second order), and the gyroscopic torque of
  // a sub-step does not yet know the joint impulses of that sub-step (first order, and small).
  const double eight = worst(SolverKind::kBpp, 8).angular.norm();
  const double sixteen = worst(SolverKind::kBpp, 16).angular.norm();
  EXPECT_LT(eight, 2e-5);
  EXPECT_LT(sixteen, eight / 2.0);
}

}  // namespace
}  // namespace substep::test
