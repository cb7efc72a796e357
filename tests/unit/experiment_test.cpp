// Experiments: text forms, ids and starts.

#include <gtest/gtest.h>

#include <set>

#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/model/setting_fields.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/unit/unusual_settings.hpp"

namespace substep::test {
namespace {

TEST(Experiment, EverySettingOfTheTestDiffersFromItsDefault) {
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;
    EXPECT_NE(setting_text(field, unusual()), setting_text(field, Settings{})) << field.name;
  }
}

TEST(Experiment, JsonRoundTripIsExact) {
  const auto scene = shared(scenes::swinging_box());
  Experiment experiment = experiment_of(*scene, unusual(), 3);
  experiment.duration = 1.0 / 3.0;
  experiment.load = 0.1;
  Problems problems;
  const auto json = parse_json(experiment_json(experiment).dump(), problems);
  ASSERT_TRUE(json.has_value());
  const auto input = read_experiment(
      *json, [&](const std::string&) { return scene; }, problems);
  ASSERT_TRUE(input.experiment.has_value()) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(*input.experiment, experiment);
  EXPECT_EQ(experiment_id(*input.experiment), experiment_id(experiment));
}

TEST(Experiment, OmittedValuesDefaultToTheScene) {
  const auto scene = shared(scenes::heavy_stack_tall());
  Problems problems;
  const auto input = read_experiment(
      Json{{"scene", "heavy_stack_tall"}}, [&](const std::string&) { return scene; }, problems);
  ASSERT_TRUE(input.experiment.has_value());
  EXPECT_EQ(input.experiment->settings, scene->settings);
  EXPECT_EQ(input.experiment->duration, scene->criteria.duration);
}

TEST(Experiment, ReportsAllProblemsAtOnce) {
  const auto scene = shared(scenes::pendulum());
  Problems problems;
  const Json json{{"scene", "pendulum"}, {"scene_hash", "0"}, {"settings", {{"alpha", 3.0}}},
                  {"seconds", -1.0},     {"seed", -1},        {"colour", "red"}};
  const auto input = read_experiment(
      json, [&](const std::string&) { return scene; }, problems);
  EXPECT_FALSE(input.experiment.has_value());
  EXPECT_EQ(problems.size(), 5U);
  problems.clear();
  EXPECT_FALSE(read_experiment(
                   Json{{"scene", "?"}}, [](const std::string&) { return nullptr; }, problems)
                   .experiment.has_value());
  EXPECT_EQ(problems.size(), 1U);
  problems.clear();
  Json other = experiment_json(experiment_of(*scene, Settings{}));
  other["seconds"] = 7.0;
  EXPECT_FALSE(read_experiment(
                   other, [&](const std::string&) { return scene; }, problems)
                   .experiment)
      << "the id belongs to another duration";
}

TEST(Experiment, IdDependsOnlyOnWhatAffectsTheRun) {
  const Scene scene = scenes::pendulum();
  const std::string id = experiment_id(experiment_of(scene, Settings{}));
  EXPECT_EQ(id.size(), 16U);
  std::set<std::string> ids{id};
  for (const SettingField& field : setting_fields()) {
    substep::Settings settings = kPaperSettings;
    if (field.name == "watch_stiffness") continue;
    EXPECT_FALSE(set_setting(field, setting_text(field, unusual()), settings));
    EXPECT_TRUE(ids.insert(experiment_id(experiment_of(scene, settings))).second) << field.name;
  }
  EXPECT_TRUE(ids.insert(experiment_id(experiment_of(scene, Settings{}, 1))).second);
  Experiment longer = experiment_of(scene, Settings{});
  longer.duration = 11.0;
  EXPECT_TRUE(ids.insert(experiment_id(longer)).second);
  longer.load = 2.0;
  EXPECT_TRUE(ids.insert(experiment_id(longer)).second);
  Scene heavier = scene;
  heavier.bodies[0].mass = 2.0;
  EXPECT_TRUE(ids.insert(experiment_id(experiment_of(heavier, Settings{}))).second);
  Scene reworded = scene;
  reworded.description = "another description";
  reworded.camera.eye.x() += 1.0;
  reworded.settings.alpha = 0.3;
  EXPECT_EQ(experiment_id(experiment_of(reworded, Settings{})), id);
}

// Stored results use the id as their key, so it must not change.
TEST(Experiment, IdOfASceneFileIsStable) {
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/free_fall.json").scene;
  ASSERT_TRUE(scene);
  EXPECT_EQ(experiment_id(experiment_of(*scene, Settings{})),
            experiment_id(experiment_of(scenes::free_fall(), Settings{})));
  EXPECT_EQ(experiment_id(experiment_of(*scene, Settings{})), "338fa7f7f23df747");
}

TEST(Experiment, ALoadScalesTheHeaviestBodyAlone) {
  const Scene scene = scenes::swinging_box();
  const Scene loaded = start_of(scene, 3.0, 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double factor = scene.bodies[i].name == "box" ? 3.0 : 1.0;
    EXPECT_EQ(loaded.bodies[i].mass, factor * scene.bodies[i].mass) << i;
    EXPECT_EQ(loaded.bodies[i].inertia, factor * scene.bodies[i].inertia) << i;
  }
  EXPECT_EQ(mass_ratio(scene), 1000.0);
  EXPECT_EQ(mass_ratio(loaded), 3000.0);
}

TEST(Experiment, SeedPerturbsOnlyMovingBodies) {
  const Scene scene = scenes::swinging_box();
  EXPECT_EQ(start_of(scene, 1.0, 0).bodies[1].velocity, scene.bodies[1].velocity);
  const Scene nudged = start_of(scene, 1.0, 5);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double by = (nudged.bodies[i].velocity - scene.bodies[i].velocity).norm();
    EXPECT_EQ(by > 0.0, !scene.bodies[i].is_static) << i;
    EXPECT_LT(by, 2e-9) << i;
    EXPECT_EQ(nudged.bodies[i].position, scene.bodies[i].position);
  }
  EXPECT_EQ(start_of(scene, 1.0, 5).bodies[1].velocity, nudged.bodies[1].velocity);
  EXPECT_NE(start_of(scene, 1.0, 6).bodies[1].velocity, nudged.bodies[1].velocity);
}

}  // namespace
}  // namespace substep::test
