// The settings of a scene that chooses none or few, wherever it comes from.

#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/presets.hpp"
#include "core/model/scene_builder.hpp"
#include "core/sim/simulator.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep::test {
namespace {

const std::string kChosen =
    R"("settings": {"solver": "bpp", "alpha": 0.1, "n": 16, "probe": true},)";
const std::string kVersion1 = R"("version": 1,)";
const std::string kVersion2 = R"("version": 2,)";

/// The small scene with other settings.
std::string scene_with(const std::string& version, const std::string& settings) {
  return with(kVersion1, version, with(kChosen, settings));
}

substep::Settings settings_of(const std::string& text) {
  EXPECT_EQ(problems_of(text), List{});
  const auto scene = read_scene(text).scene;
  return scene ? scene->settings : substep::Settings{};
}

TEST(DefaultSettings, AreThePresetSteadyAndNotThePapers) {
  EXPECT_EQ(find_preset("steady")->settings, substep::Settings{});
  EXPECT_EQ(find_preset("paper")->settings, PaperSettings{});
  const substep::Settings ours;
  const PaperSettings paper;
  EXPECT_NE(ours, paper);
  EXPECT_EQ(ours.drift, Drift::kExact);
  EXPECT_EQ(ours.detection, Detection::kContinuous);
  EXPECT_EQ(ours.friction_cone, FrictionCone::kCone);
  EXPECT_GT(ours.hold, 1);
  EXPECT_TRUE(ours.redo);
}

TEST(DefaultSettings, AreThoseOfAFileWithoutSettings) {
  for (const std::string& version : {kVersion1, kVersion2}) {
    EXPECT_EQ(settings_of(scene_with(version, "")), substep::Settings{}) << version;
    EXPECT_EQ(settings_of(scene_with(version, R"("settings": {},)")), substep::Settings{})
        << version;
  }
}

TEST(DefaultSettings, CompleteABlockOfVersion2) {
  const std::string text = scene_with(kVersion2, R"("settings": {"alpha": 0.05, "hold": 7},)");
  EXPECT_EQ(settings_of(text), (substep::Settings{.alpha = 0.05, .hold = 7}));
}

TEST(DefaultSettings, OfThePaperCompleteABlockOfVersion1) {
  const std::string text = scene_with(kVersion1, R"("settings": {"alpha": 0.05},)");
  EXPECT_EQ(settings_of(text), PaperSettings{.alpha = 0.05});
}

TEST(DefaultSettings, AreNamedByABlock) {
  for (const std::string& version : {kVersion1, kVersion2}) {
    EXPECT_EQ(settings_of(scene_with(version, R"("settings": {"n": 3, "preset": "paper"},)")),
              PaperSettings{.n = 3});
    EXPECT_EQ(settings_of(scene_with(version, R"("settings": {"n": 3, "preset": "steady"},)")),
              substep::Settings{.n = 3});
  }
  EXPECT_EQ(problems_of(scene_with(kVersion2, R"("settings": {"preset": "best"},)")),
            List{"/settings/preset: must be steady or paper, not \"best\""});
}

TEST(DefaultSettings, ReadBackWhateverTheyAre) {
  for (const Preset& preset : presets()) {
    auto scene = *read_scene(kGood).scene;
    scene.settings = preset.settings;
    EXPECT_EQ(settings_of(write_scene(scene)), preset.settings) << preset.name;
  }
}

TEST(DefaultSettings, AreThoseOfAScenePutTogetherInCode) {
  EXPECT_EQ(Scene{}.settings, substep::Settings{});
  SceneBuilder builder("own");
  builder.add_body(Sphere{0.1}, 1.0, Vec3::Zero());
  const std::shared_ptr<const Scene> scene = builder.build();
  EXPECT_EQ(scene->settings, substep::Settings{});
  EXPECT_EQ(Simulator(scene).settings(), substep::Settings{});
}

// Results of versions without some settings keep their meaning and their ids.
TEST(DefaultSettings, AreNotThoseOfAnEarlierResult) {
  const auto scene = read_scene(scene_with(kVersion1, "")).scene;
  ASSERT_NE(scene, nullptr);
  Json line = experiment_json(experiment_of(*scene, PaperSettings{.n = 3}));
  for (const char* later : {"hold", "redo"}) line["settings"].erase(later);
  Problems problems;
  const ExperimentInput read = read_experiment(
      line, [&](const std::string&) { return scene; }, problems);
  ASSERT_TRUE(read.experiment) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(read.experiment->settings, PaperSettings{.n = 3});
}

// Every scene of the paper says so, and keeps its motion when the defaults change.
TEST(DefaultSettings, AreNotThoseOfThePapersScenes) {
  for (const Scene& scene : scenes::shipped()) {
    if (scene.group != "paper" && scene.group != "authors" && scene.group != "stress") continue;
    EXPECT_NE(write_scene(scene).find(R"("preset": "paper")"), std::string::npos) << scene.name;
    EXPECT_FALSE(scene.settings.redo) << scene.name;
  }
}

}  // namespace
}  // namespace substep::test
