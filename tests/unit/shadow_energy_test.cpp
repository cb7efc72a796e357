// The energy that a run of one constant step keeps, and what tells that it grows.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/lab/doctor.hpp"
#include "core/lab/shadow_energy.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

/// Rods on ball joints that hang at rest.
Scene hanging_rods() {
  SceneBuilder builder("rods");
  int above = kWorld;
  for (int i = 0; i < 4; ++i) {
    const int rod = builder.add_body(Box{{0.02, 0.15, 0.02}}, 1.0, {0.0, -0.15 - 0.3 * i, 0.0});
    builder.body(rod).collides = false;
    builder.add_ball_joint(rod, above, {0.0, -0.3 * i, 0.0});
    above = rod;
  }
  return *builder.build();
}

struct Energies {
  double swing = 0.0;   // of the true energy, of the largest kinetic one
  double shadow = 0.0;  // of the shadow energy, likewise
  bool grows = false;   // by its own judgement, at some time
};

/// Of 300 steps. @param share of the largest step  @param believed what the judge believes it to be
Energies energies_of_run(double share, double believed) {
  DoctorQuestion question;
  question.runs = false;
  const Scene scene = hanging_rods();
  const double limit = diagnose(std::make_shared<const Scene>(scene), question).step;
  const auto run = std::make_shared<const Scene>(scene_at_step(scene, share * limit));
  Simulator simulator(run);
  const FrameReport start = simulator.observe();
  ShadowEnergy energy(*run, simulator.state(), start);
  double least[] = {start.energy, start.energy};
  double most[] = {start.energy, start.energy};
  bool grows = false;
  for (int i = 0; i < 300; ++i) {
    const FrameReport report = simulator.step();
    if (report.status != StepStatus::kOk) break;
    const double values[] = {report.energy, energy.add(*run, simulator.state(), report).energy};
    for (int j = 0; j < 2; ++j) {
      least[j] = std::min(least[j], values[j]);
      most[j] = std::max(most[j], values[j]);
    }
    grows = grows || energy.exceeds_stable(believed);
  }
  return {(most[0] - least[0]) / start.kinetic, (most[1] - least[1]) / start.kinetic, grows};
}

TEST(ShadowEnergy, IsKeptWhereTheTrueEnergySwings) {
  EXPECT_TRUE(ShadowEnergy::applies(hanging_rods()));
  for (const double share : {0.3, 0.6, 0.9}) {
    const Energies of = energies_of_run(share, share);
    EXPECT_LT(of.shadow, 0.03) << share;
    EXPECT_GT(of.swing, 0.2 * share * share) << share;
    EXPECT_FALSE(of.grows) << share;
  }
  // A swing that no step of that share has: the real one is above the limit.
  EXPECT_TRUE(energies_of_run(1.03, 0.9).grows);
  EXPECT_TRUE(energies_of_run(0.95, 0.5).grows);
}

TEST(ShadowEnergy, AppliesToExplicitStepsAlone) {
  Scene scene = hanging_rods();
  scene.effects.contact = true;
  EXPECT_FALSE(ShadowEnergy::applies(scene));
  scene = hanging_rods();
  base(scene.joints[0]).compliance = 1e-6;
  EXPECT_FALSE(ShadowEnergy::applies(scene));
}

}  // namespace
}  // namespace substep
