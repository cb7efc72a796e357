// `substep generate`, run as a program.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/sim/simulator.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

TEST(CommandLine, GeneratesTheShippedFiles) {
  for (const char* name : {"swinging_box", "bridge", "heavy_stack", "sliding_box"}) {
    const auto shipped =
        read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/" + std::string(name) + ".json").scene;
    ASSERT_NE(shipped, nullptr);
    Scene plain = *shipped;
    plain.verdicts.clear();  // they apply to the shipped start; a variant has others
    plain.settings = own_settings(plain);
    plain.recommended.reset();
    EXPECT_TRUE(substep("generate " + std::string(name)).out == write_scene(plain)) << name;
  }
}

TEST(CommandLine, GeneratesRopesOfOtherSizesMassesAndPlaces) {
  const fs::path path = folder() / "rope.json";
  const Outcome made = substep(
      "generate rope --links 3 --angle 30 --link-length 0.5 --link-width 0.05 "
      "--link-mass 0.2 --box-size 0.8 --end-mass 40 --anchor 1 7.5 -2 --out \"" +
      path.string() + "\"");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto scene = read_scene_file(path.string()).scene;
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->bodies.size(), 4U);
  EXPECT_EQ(std::get<Box>(scene->bodies[0].shape).half_extents, Vec3(0.25, 0.025, 0.025));
  EXPECT_EQ(scene->bodies[0].mass, 0.2);
  EXPECT_EQ(std::get<Box>(scene->bodies[3].shape).half_extents, Vec3(0.4, 0.4, 0.4));
  EXPECT_EQ(scene->bodies[3].mass, 40.0);
  const Vec3 anchor(1.0, 7.5, -2.0);
  EXPECT_EQ(base(scene->joints[0]).anchor_b, anchor);
  const Vec3 down(0.5, -std::sqrt(0.75), 0.0);
  EXPECT_LT((scene->bodies[3].position - anchor - 1.9 * down).norm(), 1e-14);
  EXPECT_LT(Simulator(scene).observe().joint_gap, 1e-14);
  // The limit is a tenth of the potential energy between the initial angle and the vertical; it
  // does not depend on the anchor's height.
  EXPECT_NEAR(*scene->criteria.energy_gain,
              0.1 * 9.81 * (40.0 * 1.9 + 0.2 * (0.25 + 0.75 + 1.25)) * (1.0 - std::sqrt(0.75)),
              1e-12);
  EXPECT_EQ(lines_of(substep("run \"" + path.string() + "\" --seconds 1").out).back(), "holds");
}

TEST(CommandLine, RunsAGeneratedRopeFromStandardInput) {
  const fs::path path = folder() / "rope.json";
  ASSERT_EQ(
      substep("generate rope --links 40 --angle 30 --out \"" + path.string() + "\"").exit_code, 0);
  const Outcome run = substep("run - --frames 10", "cat \"" + path.string() + "\" |");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.find("rope_of_40: "), 0U) << run.out;
  EXPECT_EQ(lines_of(run.out).back(), "holds");
}

}  // namespace
}  // namespace substep
