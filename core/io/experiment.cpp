#include "core/io/experiment.hpp"

#include <cinttypes>

#include "core/io/scene_writer.hpp"
#include "core/io/settings_json.hpp"
#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

/// FNV-1a over characters.
std::uint64_t text_hash(std::string_view text) {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    value *= 0x100000001b3ULL;
  }
  return value;
}

}  // namespace

std::string hex_text(std::uint64_t value) { return format_text("%016" PRIx64, value); }

std::uint64_t scene_hash(const Scene& scene) {
  Scene bare = scene;
  bare.title.clear();
  bare.group.clear();
  bare.description.clear();
  bare.look_for.clear();
  bare.verdicts.clear();
  bare.camera = Camera{};
  bare.settings = Settings{};
  bare.recommended.reset();
  // The default settings are omitted too: a setting added later must not change the hash.
  Json content = Json::parse(write_scene(bare), nullptr, false);
  if (!content.is_object()) return 0;  // a file cannot hold it
  content.erase("settings");
  content.erase("camera");
  // The same content as in version 1, which did not judge the energy unless the scene stated a
  // gain.
  content["version"] = 1;
  if (scene.criteria.energy_gain == kAnyEnergy) {
    content["criteria"].erase("energy_gain");
  } else if (!scene.criteria.energy_gain) {
    content["criteria"]["energy_gain"] = nullptr;
  }
  return text_hash(content.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Experiment experiment_of(const Scene& scene, const Settings& settings, int seed) {
  Experiment experiment;
  experiment.scene = scene.name;
  experiment.scene_hash = scene_hash(scene);
  experiment.settings = settings;
  experiment.settings.watch_stiffness = false;
  experiment.duration = scene.criteria.duration;
  experiment.seed = seed;
  return experiment;
}

std::string experiment_id(const Experiment& experiment) {
  std::string text = experiment.scene + ' ' + hex_text(experiment.scene_hash);
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;  // display only
    const std::string value = setting_text(field, experiment.settings);
    // The paper's never change, so that ids stay the same when the defaults do.
    if (value == setting_text(field, kPaperSettings)) continue;
    text += ' ';
    text += field.name;
    text += '=' + value;
  }
  text += " seconds=" + number_text(experiment.duration);
  if (experiment.load != 1.0) text += " load=" + number_text(experiment.load);
  text += " seed=" + std::to_string(experiment.seed);
  return hex_text(text_hash(text));
}

Json experiment_json(const Experiment& experiment) {
  Json json;
  json["id"] = experiment_id(experiment);
  json["scene"] = experiment.scene;
  json["scene_hash"] = hex_text(experiment.scene_hash);
  json["settings"] = settings_json(experiment.settings);
  json["settings"].erase("watch_stiffness");
  json["seconds"] = experiment.duration;
  json["load"] = experiment.load;
  json["seed"] = experiment.seed;
  return json;
}

ExperimentInput read_experiment(const Json& json, const SceneFinder& find, Problems& problems) {
  constexpr std::size_t kLongest = 1000;  // [bytes]
  const std::size_t before = problems.size();
  ObjectReader in(json, "", problems);
  ExperimentInput input;
  Experiment experiment;
  std::string id;
  std::string hash;
  if (in.text("scene", kLongest, experiment.scene, kRequired)) {
    input.scene = find(experiment.scene);
    if (!input.scene) in.problem("scene", "no scene is called " + value_text(experiment.scene));
  }
  if (input.scene) experiment = experiment_of(*input.scene, input.scene->settings);
  // The program wrote lines with an id, and all settings that there were then.
  if (in.member("id", kOptional)) experiment.settings = kPaperSettings;
  read_settings(in, experiment.settings, problems);
  in.number("seconds", kDurationRange, experiment.duration, kOptional);
  in.number("load", kLoadRange, experiment.load, kOptional);
  in.integer("seed", 0, kMostSeed, experiment.seed, kOptional);
  if (in.text("scene_hash", kLongest, hash, kOptional) && input.scene &&
      hash != hex_text(experiment.scene_hash)) {
    in.problem("scene_hash", must_be(hex_text(experiment.scene_hash), value_text(hash)) +
                                 ": the scene has changed");
  }
  if (in.text("id", kLongest, id, kOptional) && problems.size() == before &&
      id != experiment_id(experiment)) {
    in.problem("id",
               must_be(experiment_id(experiment) + ", the id of this experiment", value_text(id)));
  }
  in.finish();
  if (problems.size() == before) input.experiment = std::move(experiment);
  return input;
}

std::string command_line(const Experiment& experiment, const Scene& scene) {
  std::string command =
      "substep run " + scene.name + setting_flags(experiment.settings, scene.settings);
  if (experiment.duration != scene.criteria.duration) {
    command += " --seconds " + number_text(experiment.duration);
  }
  if (experiment.load != 1.0) command += " --load " + number_text(experiment.load);
  if (experiment.seed != 0) command += " --seed " + std::to_string(experiment.seed);
  return command;
}

}  // namespace substep
