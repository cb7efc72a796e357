#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/json.hpp"
#include "core/model/effects.hpp"

namespace substep::cli {
namespace {

std::string effect_list(const Effects& effects) {
  std::string list;
  for (const EffectEntry& effect : kEffects) {
    if (!(effects.*effect.member)) continue;
    if (!list.empty()) list += ", ";
    list += effect.name;
  }
  return list;
}

int list_scenes(bool as_json) {
  int exit_code = kOk;
  Json results = Json::array();
  if (!as_json)
    say(stdout, "%-24s %-8s %6s %6s  %s\n", "name", "group", "bodies", "joints", "effects");
  for (const std::string& name : shipped_names()) {
    const auto scene = load_scene(name);
    if (!scene) {
      exit_code = kBadInput;
      continue;
    }
    if (as_json) {
      Json result;
      result["name"] = scene->name;
      result["title"] = scene->title;
      result["group"] = scene->group;
      result["description"] = scene->description;
      result["look_for"] = scene->look_for;
      result["bodies"] = scene->bodies.size();
      result["joints"] = scene->joints.size();
      Json& effects = result["effects"] = Json::array();
      for (const EffectEntry& effect : kEffects) {
        if (scene->effects.*effect.member) effects.push_back(effect.name);
      }
      results.push_back(result);
    } else {
      say(stdout, "%-24s %-8s %6zu %6zu  %s\n", scene->name.c_str(), scene->group.c_str(),
          scene->bodies.size(), scene->joints.size(), effect_list(scene->effects).c_str());
    }
  }
  if (as_json) {
    say(stdout, "%s\n", results.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  }
  return exit_code;
}

}  // namespace

void add_scenes(CLI::App& app, int& exit_code) {
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("scenes", "List the shipped scenes");
  command->add_flag("--json", *as_json, "print JSON, with descriptions");
  command->footer("They are read from the folder in SUBSTEP_SCENES if it is set.");
  command->callback([as_json, &exit_code] { exit_code = list_scenes(*as_json); });
}

}  // namespace substep::cli
