// Counting is exact, so a test can check that the benchmarks show 0 allocations.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "core/io/scene_reader.hpp"
#include "core/lab/presets.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/bench/allocations.hpp"
#include "tests/bench/cases.hpp"
#include "tests/support/placed.hpp"

namespace {

using namespace substep;

TEST(Allocations, AreCounted) {
  const std::int64_t before = bench::allocations();
  const auto one = std::make_unique<double>(1.0);
  EXPECT_EQ(bench::allocations() - before, *one);
}

class Stepping : public testing::TestWithParam<std::tuple<bench::Case, Mode>> {};

TEST_P(Stepping, AllocatesNothingAfterTheFirstFrame) {
  const auto& [c, mode] = GetParam();
  bench::Loop loop(SUBSTEP_SOURCE_DIR "/scenes", c, mode);
  loop.step();
  const std::int64_t before = loop.allocated();
  int first_frame = -1;
  for (int frame = 1; frame < bench::Loop::kFrames; ++frame) {
    const FrameReport report = loop.step();
    ASSERT_EQ(report.status, StepStatus::kOk);
    if (first_frame < 0 && loop.allocated() != before) first_frame = frame;
  }
  EXPECT_EQ(loop.allocated() - before, 0) << "the first one in frame " << first_frame;
}

/// Allocations in the 90 frames after the first.
std::int64_t allocated(const Scene& scene, const Settings& settings) {
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(settings);
  simulator.step();
  const std::int64_t before = bench::allocations();
  for (int frame = 0; frame < 90; ++frame) simulator.step();
  return bench::allocations() - before;
}

std::int64_t allocated(const std::string& scene_name, const Settings& settings) {
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/" + scene_name + ".json").scene;
  return scene ? allocated(*scene, settings) : -1;
}

TEST(SolversOfTheWholeSubstep, AllocateNothingAfterTheFirstFrame) {
  for (const char* name : {"swinging_box", "bridge"}) {
    for (const SolverKind solver : {SolverKind::kXpbd, SolverKind::kNewton}) {
      for (const Forces forces : {Forces::kEnd, Forces::kMean}) {
        const PaperSettings settings{.solver = solver, .forces = forces, .mode = Mode::kConst};
        EXPECT_EQ(allocated(name, settings), 0) << name << ", " << name_of(solver);
      }
    }
  }
}

// The first impact too.
TEST(LimitsMotorsAndDrives, AllocateNothingAfterTheFirstFrame) {
  SceneBuilder builder("arm");
  int last = kWorld;
  for (int i = 0; i < 3; ++i) {
    const int body = builder.add_body(Box{{0.25, 0.04, 0.03}}, 1.0, {0.25 + 0.5 * i, 0.0, 0.0});
    builder.body(body).collides = false;
    const int hinge = builder.add_hinge(body, last, {0.5 * i, 0.0, 0.0}, Vec3::UnitZ());
    builder.limit(hinge, -0.4, 0.6, 0.5);
    if (i == 2) builder.drive(hinge, 2.0, 1.5);
    if (i > 0) builder.rub(hinge, 0.1);
    builder.add_armature(hinge, 0.05);
    builder.add_spring(hinge, {.stiffness = 5.0, .damping = 0.1});
    if (i == 1) {
      builder.drive(hinge, {.target = 1.0, .stiffness = 20.0, .damping = 1.0, .effort = 5.0});
    }
    last = body;
  }
  const int ball = builder.add_body(Sphere{0.05}, 0.5, {1.5, -0.2, 0.0});
  builder.body(ball).collides = false;
  builder.add_rope(ball, last, {1.5, -0.2, 0.0}, {1.5, 0.0, 0.0}, 0.4, 0.5);
  EXPECT_EQ(allocated(*builder.build(), substep::Settings{}), 0);
}

// Predicted contacts, shared sweeps, refinements.
TEST(SmallStepsAndRefinements, AllocateNothingAfterTheFirstFrame) {
  for (const auto& [name, solver] :
       {std::pair{"bridge", SolverKind::kPgs}, std::pair{"bridge", SolverKind::kBpp},
        std::pair{"heavy_stack_stress", SolverKind::kBpp}}) {
    const PaperSettings settings{.solver = solver,
                                 .share_iterations = true,
                                 .refinements = 2,
                                 .mode = Mode::kConst,
                                 .detection = Detection::kFrame};
    EXPECT_EQ(allocated(name, settings), 0) << name << ", " << name_of(solver);
  }
}

/// A square of four hinged bars that lands on one of them after half a second.
Scene falling_loop() {
  SceneBuilder builder("falling loop");
  builder.add_fixed(Plane{}, {0, 0, 0});
  const Vec3 centre(0.0, 1.8, 0.0);
  const Vec3 corners[] = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  int bars[4];
  for (int i = 0; i < 4; ++i) {
    const bool lies = i % 2 == 0;
    const Vec3 half = lies ? Vec3(0.4, 0.05, 0.05) : Vec3(0.05, 0.4, 0.05);
    bars[i] = builder.add_body(Box{half}, 1.0, centre + 0.5 * (corners[i] + corners[(i + 1) % 4]));
    builder.body(bars[i]).collides = i == 0;
  }
  for (int i = 0; i < 4; ++i) {
    builder.add_hinge(bars[i], bars[(i + 1) % 4], centre + corners[(i + 1) % 4], Vec3::UnitZ());
  }
  return *builder.build();
}

// Bodies that tumble on joints, the closed loop whose redundant rows are refined, and the cone.
TEST(BodiesInSpaceLoopsAndCones, AllocateNothingAfterTheFirstFrame) {
  for (const char* name : {"spherical_pendulum", "heavy_top", "whirling_chain"}) {
    for (const Integrator integrator :
         {Integrator::kEuler, Integrator::kLeapfrog, Integrator::kStormer}) {
      EXPECT_EQ(allocated(name, PaperSettings{.integrator = integrator}), 0)
          << name << ", " << name_of(integrator);
    }
  }
  for (const Integrator integrator : {Integrator::kLeapfrog, Integrator::kStormer}) {
    const PaperSettings settings{.mode = Mode::kConst, .integrator = integrator};
    EXPECT_EQ(allocated(scenes::exam_bricard().scene, settings), 0) << name_of(integrator);
  }
  EXPECT_EQ(allocated(falling_loop(), Settings{}), 0);
  EXPECT_EQ(allocated(falling_loop(), PaperSettings{}), 0);
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs, SolverKind::kXpbd}) {
    const PaperSettings settings{.solver = solver, .friction_cone = FrictionCone::kCone};
    EXPECT_EQ(allocated("bridge", settings), 0) << name_of(solver);
  }
}

// Frames are taken again, joints are solved repeatedly, with contacts and islands as well.
TEST(SteadySubsteps, AllocateNothingAfterTheFirstFrame) {
  Settings settings = find_preset("steady")->settings;
  for (const char* name : {"swinging_box", "whirling_chain", "bridge"}) {
    EXPECT_EQ(allocated(name, settings), 0) << name;
  }
  settings.islands = true;
  settings.policy = Policy::kSubstep;
  EXPECT_EQ(allocated("bridge", settings), 0);
}

// Three clocks, and later two.
TEST(IslandsWithClocksOfTheirOwn, AllocateNothingAfterTheFirstFrame) {
  const auto aside = [](const Scene& scene, double z) {
    return test::transformed(scene, Quat::Identity(), Vec3{0.0, 0.0, z});
  };
  const Scene scene = test::beside(
      {aside(scenes::swinging_box(), -30.0), scenes::bridge(), aside(scenes::pendulum(), 30.0)});
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    for (const Detection detection : {Detection::kSubstep, Detection::kFrame}) {
      const PaperSettings settings{.solver = solver, .islands = true, .detection = detection};
      EXPECT_EQ(allocated(scene, settings), 0) << name_of(solver) << ", " << name_of(detection);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ScenesAndSolvers, Stepping,
                         testing::Combine(testing::ValuesIn(bench::kCases),
                                          testing::Values(Mode::kConst, Mode::kAdaptive)),
                         [](const auto& instance) {
                           std::string name = bench::name_of_case(std::get<0>(instance.param));
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name + (std::get<1>(instance.param) == Mode::kConst
                                              ? "_const"
                                              : "_adaptive");
                         });

}  // namespace
