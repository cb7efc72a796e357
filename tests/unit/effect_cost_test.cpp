// The cost of each effect of a scene.

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "core/io/experiment.hpp"
#include "core/lab/effect_cost.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::test {
namespace {

TEST(EffectCost, IsTheCostSavedByLeavingTheEffectOut) {
  Scene scene = scenes::bridge();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.solver = SolverKind::kPgs;
  experiment.duration = 0.5;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  ASSERT_EQ(costs.effects.size(), 4U);  // gravity, joints, contact, friction
  std::map<std::string_view, EffectCost> by_name;
  for (const EffectCost& cost : costs.effects) by_name[cost.effect] = cost;
  EXPECT_GT(by_name["friction"].row_updates, 0.0);
  EXPECT_GT(by_name["contact"].row_updates, by_name["friction"].row_updates)
      << "without contact there is no friction";
  EXPECT_GT(by_name["joints"].flops, by_name["contact"].flops);

  experiment.settings.solver = SolverKind::kBpp;
  const CostBreakdown direct = cost_of_effects(scene, experiment);
  const CostBreakdown again = cost_of_effects(scene, experiment);
  for (std::size_t i = 0; i < direct.effects.size(); ++i) {
    EXPECT_EQ(direct.effects[i].flops, again.effects[i].flops) << direct.effects[i].effect;
  }
}

TEST(EffectCost, OfJointsAloneIsEveryRowUpdate) {
  const Scene scene = scenes::swinging_box();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.solver = SolverKind::kPgs;
  experiment.duration = 0.1;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  const Work& work = costs.run.work;
  const auto frames = static_cast<double>(work.frames);
  ASSERT_EQ(costs.effects.size(), 2U);
  EXPECT_EQ(costs.effects[0].effect, "gravity");
  EXPECT_EQ(costs.effects[0].row_updates, 0.0);
  EXPECT_EQ(costs.effects[1].effect, "joints");
  EXPECT_DOUBLE_EQ(
      costs.effects[1].row_updates * frames,
      25.0 * 130.0 * static_cast<double>(work.substeps));  // the probe belongs to no frame
}

// Each simulator keeps its own totals: the run, the unchanged scene, and the scenes without gravity
// and contact.
TEST(EffectCost, ItsSimulatorsShareOneMemoryBudget) {
  SceneBuilder builder("spheres");
  for (int i = 0; i < 130; ++i) builder.add_body(Sphere{0.1}, 1.0, {0, 0, 0});
  const std::shared_ptr<const Scene> scene = builder.build();
  ASSERT_NE(scene, nullptr);
  Simulator alone(scene);
  EXPECT_EQ(alone.step().status, StepStatus::kOk);
  Experiment experiment = experiment_of(*scene, scene->settings);
  experiment.duration = scene->frame;
  const CostBreakdown costs = cost_of_effects(*scene, experiment);
  ASSERT_EQ(costs.effects.size(), 2U);
  EXPECT_NE(costs.run.verdict.find("the budget is 128 MiB"), std::string::npos)
      << costs.run.verdict;
}

// Until the ball hits the tower, its chain takes 12 sub-steps per frame and the tower one.
TEST(EffectCost, OfAnEffectIsAtMostTheWholeCostWithIslands) {
  const Scene scene = scenes::wrecking_ball();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.islands = true;
  experiment.duration = 0.1;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  const Work& work = costs.run.work;
  ASSERT_EQ(costs.effects.size(), 5U);
  for (const EffectCost& cost : costs.effects) {
    EXPECT_LE(cost.flops * static_cast<double>(work.frames), static_cast<double>(work.flops))
        << cost.effect;
  }
  EXPECT_EQ(costs.effects[3].effect, "contact");
  EXPECT_GT(costs.effects[3].flops, 0.5 * static_cast<double>(work.flops / work.frames));
}

}  // namespace
}  // namespace substep::test
