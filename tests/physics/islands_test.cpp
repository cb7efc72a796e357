// Separate sub-steps for unconnected bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/model/names.hpp"
#include "core/sim/islands.hpp"
#include "scenes/generator/hard_set.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"

namespace substep::test {
namespace {

constexpr double kFrame = 1.0 / 60.0;

Settings with_islands(Settings settings = {}) {
  settings.islands = true;
  return settings;
}

Scene aside(const Scene& scene, double z) {
  return transformed(scene, Quat::Identity(), Vec3{0.0, 0.0, z});
}

TEST(Islands, AConnectedSceneMovesAsWithoutThem) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::heavy_stack_stress()}) {
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
        for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kNewton}) {
          Settings settings = scene.settings;
          settings.solver = solver;
          settings.policy = policy;
          settings.integrator = integrator;
          Simulator one = simulator_of(scene, settings);
          Simulator other = simulator_of(scene, with_islands(settings));
          int frame = 0;
          for (; frame < 20; ++frame) {
            const FrameReport a = one.step();
            const FrameReport b = other.step();
            if (b.islands > 1) break;  // a stack that has fallen
            ASSERT_EQ(a.n_substeps, b.n_substeps) << scene.name << ", " << name_of(solver);
            ASSERT_EQ(b.n_mean, b.n_substeps);
            ASSERT_EQ(a.work.flops, b.work.flops);
            ASSERT_EQ(state_hash(one.state()), state_hash(other.state()));
          }
          EXPECT_GT(frame, 5);
        }
      }
    }
  }
}

/// Bit-identical; with Newton within its tolerance: islands solved together, by the probe or with
/// the same number of sub-steps, iterate until the last of them has converged.
void expect_same(const Vec6& alone, const Vec6& together, SolverKind solver) {
  if (solver != SolverKind::kNewton) {
    ASSERT_EQ(alone, together);
  } else {
    ASSERT_LT((alone - together).norm(), 1e-9 * (1.0 + alone.norm()));
  }
}

// A light chain, a heavy one, a stack and a body in flight.
TEST(Islands, EachMovesAsItWouldAlone) {
  scenes::RopeOptions light;
  light.n = 10;
  light.end_mass = 5.0;
  scenes::RopeOptions heavy;
  heavy.n = 15;
  heavy.end_mass = 2000.0;
  const std::vector<Scene> alone{
      aside(scenes::rope_of_n(light), -40.0), aside(scenes::rope_of_n(heavy), 0.0),
      aside(scenes::heavy_stack_stress(), 40.0), aside(scenes::spinning_top(), 80.0)};
  const Scene together = beside(alone);
  for (const SolverKind solver :
       {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kXpbd, SolverKind::kNewton}) {
    for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
      Settings settings;
      settings.solver = solver;
      settings.integrator = integrator;
      SCOPED_TRACE(std::string(name_of(solver)) + " " + std::string(name_of(integrator)));
      Simulator all = simulator_of(together, with_islands(settings));
      std::vector<Simulator> single;
      for (Scene scene : alone) {
        scene.contact = together.contact;
        scene.gravity = together.gravity;
        scene.effects.gravity = together.effects.gravity;
        scene.effects.gyroscopic = together.effects.gyroscopic;
        scene.regularisation = together.regularisation;
        single.push_back(simulator_of(scene, with_islands(settings)));
      }
      int fewer = 0;
      for (int frame = 0; frame < 30; ++frame) {
        const FrameReport report = all.step();
        ASSERT_EQ(report.status, StepStatus::kOk);
        int islands = 0;
        int most = 0;
        std::size_t first = 0;
        for (Simulator& one : single) {
          const FrameReport own = one.step();
          most = std::max(most, own.n_substeps);
          islands += own.islands;
          for (std::size_t i = 0; i < one.state().x.size(); ++i) {
            SCOPED_TRACE(std::to_string(frame) + ": body " + std::to_string(i) + " of " +
                         one.scene().name);
            expect_same(one.state().u[i], all.state().u[first + i], solver);
            Vec6 alone_at;
            Vec6 together_at;
            alone_at << one.state().x[i], one.state().q[i].vec();
            together_at << all.state().x[first + i], all.state().q[first + i].vec();
            expect_same(alone_at, together_at, solver);
            ASSERT_FALSE(HasFatalFailure());
          }
          first += one.state().x.size();
        }
        EXPECT_EQ(report.n_substeps, most);
        EXPECT_EQ(report.islands, islands) << "four, until the stack has fallen";
        fewer += report.n_mean < most ? 1 : 0;
      }
      EXPECT_GT(fewer, 20);
    }
  }
}

TEST(Islands, ATowerTakesFewUntilTheBallOnItsChainIsNear) {
  const Scene scene = scenes::wrecking_ball();
  Simulator one = simulator_of(scene, Settings{});
  Simulator other = simulator_of(scene, with_islands());
  std::int64_t flops = 0;
  std::int64_t flops_with = 0;
  for (int frame = 0; frame < 60; ++frame) {
    flops += one.step().work.flops;
    const FrameReport report = other.step();
    flops_with += report.work.flops;
    EXPECT_EQ(report.islands, 2) << frame;
    EXPECT_LT(report.n_mean, 0.8 * report.n_substeps);
  }
  EXPECT_LT(static_cast<double>(flops_with), 0.5 * static_cast<double>(flops));
}

// The second ball may be struck within the frame, and then the third by the second: at the start of
// the frame only the first is fast.
TEST(Islands, AStruckBodyMayStrikeTheNextWithinTheFrame) {
  for (const double speed : {5.0, 30.0, 100.0}) {
    const double way = speed * kFrame;
    Scene scene;
    scene.effects = {.contact = true};
    for (const double x : {0.0, 0.2 + 0.9 * way, 0.4 + 1.8 * way, 0.6 + 4.0 * way}) {
      Body body;
      body.shape = Sphere{0.1};
      body.position.x() = x;
      scene.bodies.push_back(body);
    }
    scene.bodies[0].velocity.x() = speed;
    const State state = initial_state(scene);
    const std::vector<Mat3> R(scene.bodies.size(), Mat3::Identity());
    Detector detector(scene);
    Islands islands(scene);
    islands.find(scene, whole(scene), state, R, kFrame, &detector);
    ASSERT_EQ(islands.count(), 2);
    EXPECT_EQ(std::vector<int>(islands.bodies(0).begin(), islands.bodies(0).end()),
              (std::vector{0, 1, 2}));
    islands.find(scene, whole(scene), state, R, kFrame, nullptr);
    EXPECT_EQ(islands.count(), 4) << "where nothing touches";
  }
}

// Free flight is exact with leapfrog for any sub-steps: they follow a chain's until islands are
// switched on, and again afterwards.
TEST(Islands, LeapfrogKeepsItsOrderWhenTheyAreSwitched) {
  Scene flying = scenes::free_fall();
  flying.bodies.resize(1);
  flying.bodies[0].velocity = Vec3{3.0, 20.0, 0.0};
  const Scene scene = beside({aside(flying, -30.0), scenes::swinging_box()});
  const Vec3 x0 = scene.bodies[0].position;
  Settings settings;
  settings.integrator = Integrator::kLeapfrog;
  Simulator simulator = simulator_of(scene, settings);
  for (int frame = 1; frame <= 90; ++frame) {
    settings.islands = frame % 20 >= 7;
    simulator.set_settings(settings);
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.islands, settings.islands ? 2 : 0);
    const double t = frame * kFrame;
    const Vec3 expected = x0 + t * scene.bodies[0].velocity + 0.5 * t * t * scene.gravity;
    ASSERT_LT((simulator.state().x[0] - expected).norm(), 1e-11) << frame;
  }
}

TEST(Islands, SubstepsTakenOneByOneMakeTheSameFrames) {
  const Scene scene = scenes::wrecking_ball();
  Simulator whole = simulator_of(scene, with_islands());
  Simulator single = simulator_of(scene, with_islands());
  for (int frame = 0; frame < 10; ++frame) {
    const FrameReport at_once = whole.step();
    FrameReport report = single.substep();
    int calls = 1;
    for (; single.substeps_left() > 0; ++calls) {
      EXPECT_TRUE(single.constraint_forces().joints.empty() ||
                  single.constraint_forces().joints.size() == scene.joints.size());
      report = single.substep();
    }
    EXPECT_EQ(report.n_substeps, at_once.n_substeps);
    EXPECT_EQ(report.n_mean, at_once.n_mean);
    EXPECT_GT(calls, report.n_substeps) << "those of the tower, and those of the ball";
    EXPECT_EQ(report.joint_rows, at_once.joint_rows);
    EXPECT_EQ(report.contact_rows, at_once.contact_rows);
    EXPECT_EQ(state_hash(whole.state()), state_hash(single.state()));
  }
}

TEST(Islands, AGrabAffectsOnlyItsOwn) {
  const Scene scene =
      beside({aside(scenes::swinging_box(), -30.0), aside(scenes::heavy_stack(), 30.0)});
  const int box = *scenes::swinging_box().criteria.track;
  Simulator simulator = simulator_of(scene, with_islands());
  simulator.step();
  Simulator untouched = simulator_of(scene, with_islands());
  untouched.step();
  Grab grab;
  grab.body = box;
  grab.target = simulator.state().x[static_cast<std::size_t>(box)] + Vec3{0.0, 0.5, 0.0};
  simulator.set_grab(grab);
  for (int frame = 0; frame < 10; ++frame) {
    const FrameReport report = simulator.step();
    untouched.step();
    EXPECT_EQ(report.islands, 2);
    EXPECT_GT(report.work.rows.grab, 0);
  }
  const std::size_t first_of_stack = scenes::swinging_box().bodies.size();
  EXPECT_NE(simulator.state().x[static_cast<std::size_t>(box)],
            untouched.state().x[static_cast<std::size_t>(box)]);
  for (std::size_t i = first_of_stack; i < scene.bodies.size(); ++i) {
    EXPECT_EQ(simulator.state().x[i], untouched.state().x[i]);
  }
}

// Everything that holds without islands holds with them, except for a ragdoll that needed another's
// sub-steps: alone, it tears on landing too.
TEST(Islands, TheHardSetHoldsAsWithoutThem) {
  int fewer = 0;
  for (const scenes::HardCase& hard : scenes::hard_set()) {
    Settings settings = hard.scene.settings;
    settings.mode = Mode::kCapped;
    const double seconds = hard.scene.criteria.duration;
    const Outcome one = run(hard.scene, settings, seconds);
    if (!one.holds) continue;
    double saved = 0.0;
    const Outcome other = run(hard.scene, with_islands(settings), seconds,
                              [&](const Simulator&, const FrameReport& report) {
                                saved += report.n_substeps - report.n_mean;
                              });
    EXPECT_EQ(other.holds, hard.scene.name != "ragdoll_heap")
        << hard.scene.name << ": " << other.verdict;
    if (saved > 0.0) ++fewer;
  }
  EXPECT_GT(fewer, 3) << "scenes in which some bodies took fewer";
}

TEST(Islands, TheRagdollThatNeededOthersSubstepsTearsAlone) {
  const Scene heap = scenes::ragdoll_drop();
  Scene alone = heap;
  const auto is_other = [](const Body& body) {
    return !body.is_static && !body.name.starts_with("doll_2_");
  };
  std::vector<int> place;  // of each body of the heap, -1: left out
  alone.bodies.clear();
  for (const Body& body : heap.bodies) {
    place.push_back(is_other(body) ? -1 : static_cast<int>(alone.bodies.size()));
    if (!is_other(body)) alone.bodies.push_back(body);
  }
  alone.joints.clear();
  for (Joint joint : heap.joints) {
    JointBase& j = base(joint);
    if (place[static_cast<std::size_t>(j.a)] < 0) continue;
    j.a = place[static_cast<std::size_t>(j.a)];
    j.b = place[static_cast<std::size_t>(j.b)];
    alone.joints.push_back(joint);
  }
  Settings settings;
  settings.mode = Mode::kCapped;
  const Outcome of_heap = run(heap, with_islands(settings), 1.0);
  const Outcome of_one = run(alone, settings, 1.0);
  EXPECT_FALSE(of_one.holds);
  EXPECT_EQ(of_one.failed_at, of_heap.failed_at);
}

}  // namespace
}  // namespace substep::test
