#include "core/io/scene_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <utility>

#include "core/io/body_names.hpp"
#include "core/io/body_reader.hpp"
#include "core/io/carried_json.hpp"
#include "core/io/effect_names.hpp"
#include "core/io/joint_reader.hpp"
#include "core/io/object_reader.hpp"
#include "core/io/recommended_json.hpp"
#include "core/io/settings_json.hpp"
#include "core/io/verdicts_json.hpp"
#include "core/lab/start_text.hpp"
#include "core/model/effects_of.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_checks.hpp"
#include "core/model/scene_limits.hpp"
#include "core/sim/joint_starts.hpp"

namespace substep {
namespace {

/// Whether this is a scene of a version that can be read at all. If not, nothing else is worth
/// telling.
bool read_version(ObjectReader& in, Problems& problems) {
  const std::size_t before = problems.size();
  std::string format;
  if (in.text("format", kMaxProse, format, kRequired) && format != "substep-scene") {
    in.problem("format", value_text(format) + " is not \"substep-scene\"");
  }
  if (const Json* version = in.member("version", kRequired); version && *version != 1) {
    in.problem("version", value_text(*version) + " is not 1, the only version that is known");
  }
  return problems.size() == before;
}

void read_about(ObjectReader& in, Scene& scene) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_-";
  if (in.text("name", kMaxNameSize, scene.name, kRequired) &&
      scene.name.find_first_not_of(kLetters) != std::string::npos) {
    in.problem("name", value_text(scene.name) + " is not made of a-z, 0-9, _ and - only");
  }
  in.text("title", kMaxTitle, scene.title, kRequired);
  in.text("group", kMaxTitle, scene.group, kOptional);
  in.text("description", kMaxProse, scene.description, kOptional);
  in.text("look_for", kMaxProse, scene.look_for, kOptional);
}

void read_camera(ObjectReader& parent, Scene& scene, Problems& problems) {
  const Json* json = parent.member("camera", kOptional);
  if (!json) return;
  ObjectReader in(*json, parent.pointer("camera"), problems);
  const bool eye = in.vector("eye", kPositionRange, scene.camera.eye, kRequired);
  const bool target = in.vector("target", kPositionRange, scene.camera.target, kRequired);
  if (eye && target && scene.camera.eye == scene.camera.target) {
    in.problem("target", "the same point as eye");
  }
  in.finish();
}

void read_contact(ObjectReader& parent, Scene& scene, Problems& problems) {
  const Json* json = parent.member("contact", kOptional);
  if (!json) return;
  ObjectReader in(*json, parent.pointer("contact"), problems);
  in.number("compliance", kComplianceRange, scene.contact.compliance, kOptional);
  in.number("friction_compliance", kComplianceRange, scene.contact.friction_compliance, kOptional);
  in.number("margin", kMarginRange, scene.contact.margin, kOptional);
  in.number("restitution_speed", kRestitutionSpeedRange, scene.contact.restitution_speed,
            kOptional);
  in.finish();
}

void read_criteria(ObjectReader& parent, const BodyNames& names, Scene& scene, Problems& problems) {
  const Json* json = parent.member("criteria", kOptional);
  if (!json) return;
  ObjectReader in(*json, parent.pointer("criteria"), problems);
  Criteria& criteria = scene.criteria;
  double value = 0.0;
  in.number("duration", kDurationRange, criteria.duration, kOptional);
  in.number("joint_gap", kDistanceRange, criteria.joint_gap, kOptional);
  if (in.number("energy_gain", kEnergyRange, value, kOptional)) criteria.energy_gain = value;
  if (in.number("energy_scale", kEnergyRange, value, kOptional)) criteria.energy_scale = value;
  const auto read_body_name = [&](ObjectReader& reader, std::string_view key, Presence presence) {
    auto body = names.read(reader, key, presence);
    if (body == kWorld) {
      reader.problem(key, "\"world\" is not a body");
      body.reset();
    }
    return body;
  };
  if (const Json* moved = in.member("displacement", kOptional)) {
    ObjectReader part(*moved, in.pointer("displacement"), problems);
    Criteria::Displacement displacement;
    const auto body = read_body_name(part, "body", kRequired);
    part.number("distance", kDistanceRange, displacement.distance, kRequired);
    part.finish();
    displacement.body = body.value_or(0);
    criteria.displacement = displacement;
  }
  criteria.track = read_body_name(in, "track", kOptional);
  std::string expected = "holds";
  if (in.text("expected", kMaxNameSize, expected, kOptional)) {
    if (expected != "holds" && expected != "fails") {
      in.problem("expected", value_text(expected) + " is not holds or fails");
    }
    criteria.holds = expected == "holds";
  }
  in.finish();
}

/// The items of a list, or nothing where it is missing, no list or too long.
const Json* read_list(ObjectReader& in, std::string_view key, std::size_t most, Presence presence) {
  const Json* list = in.member(key, presence);
  if (!list) return nullptr;
  if (!list->is_array()) {
    in.problem(key, value_text(*list) + " is not a list");
    return nullptr;
  }
  if (list->size() > most) {
    in.problem(key, std::to_string(list->size()) + " are more than " + std::to_string(most));
    return nullptr;
  }
  return list;
}

void read_bodies(ObjectReader& in, Scene& scene, SoundParts& sound, Problems& problems) {
  const Json* list = read_list(in, "bodies", kMaxBodies, kRequired);
  if (!list) return;
  for (std::size_t i = 0; i < list->size() && problems.size() <= kMaxProblems; ++i) {
    const std::size_t before = problems.size();
    scene.bodies.push_back(read_body((*list)[i], pointer_to("/bodies", i), problems));
    sound.bodies.push_back(problems.size() == before);
  }
  const auto moves = [](const Body& body) { return !body.is_static; };
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), moves)) {
    in.problem("bodies", "no body moves");
  }
}

void read_joints(ObjectReader& in, const BodyNames& names, Scene& scene, SoundParts& sound,
                 Problems& problems) {
  const Json* list = read_list(in, "joints", kMaxJoints, kOptional);
  if (!list) return;
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < list->size() && problems.size() <= kMaxProblems; ++i) {
    const std::string pointer = pointer_to("/joints", i);
    const std::size_t before = problems.size();
    scene.joints.push_back(read_joint((*list)[i], pointer, names, problems));
    sound.joints.push_back(problems.size() == before);
    const std::string& name = base(scene.joints.back()).name;
    const auto [other, is_new] = first.emplace(name, i);
    if (!is_new && !name.empty()) {
      problems.push_back(
          {pointer_to(pointer, "name"), value_text(name) + " is the name of /joints/" +
                                            std::to_string(other->second) + " already"});
    }
  }
}

/// The list as it is written. @return whether there is one
bool read_effects(ObjectReader& in, Scene& scene) {
  const Json* list = read_list(in, "effects", 100, kOptional);
  if (!list) return in.member("effects", kOptional) != nullptr;
  std::vector<std::string_view> names;
  for (const NamedEffect& effect : kEffectNames) names.push_back(effect.name);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& name = (*list)[i];
    const auto found = std::find_if(kEffectNames.begin(), kEffectNames.end(),
                                    [&](const NamedEffect& effect) { return name == effect.name; });
    if (found == kEffectNames.end()) {
      in.item_problem("effects", i, value_text(name) + " is not " + one_of(names));
    } else if (scene.effects.*found->member) {
      in.item_problem("effects", i, value_text(name) + " stands twice");
    } else {
      scene.effects.*found->member = true;
    }
  }
  return true;
}

/// A listed scene must list all that its content needs.
void check_listed_effects(ObjectReader& in, const Scene& scene, Problems& problems) {
  const Effects& listed = scene.effects;
  const auto missing = [&](std::string_view effect, const std::string& why) {
    std::string message = value_text(effect);
    message += " is missing, and ";
    message += why;
    in.problem("effects", message);
  };
  if (!listed.gravity && in.member("gravity", kOptional)) missing("gravity", "/gravity is given");
  if (!listed.contact && in.member("contact", kOptional)) missing("contact", "/contact is given");
  check_effects(scene, problems);
}

void read_start(ObjectReader& in, Scene& scene) {
  std::string name;
  if (!in.text("start", kMaxNameSize, name, kOptional)) return;
  if (const auto policy = value_of<StartPolicy>(name)) {
    scene.start = *policy;
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& entry : NameTable<StartPolicy>::entries) names.push_back(entry.name);
  in.problem("start", value_text(name) + " is not " + one_of(names));
}

/// Every joint of a sound scene agrees with its poses and velocities, within the tolerances of
/// sim/joint_starts.hpp. A scene that continues a saved run is not checked.
void check_refused(const Scene& scene, Problems& problems) {
  if (scene.carried) return;
  const std::vector<JointStart> starts = joint_starts(scene, initial_state(scene));
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!starts[i].beyond.any()) continue;
    problems.push_back({pointer_to("/joints", i),
                        "\"start\" is \"refuse\", and this joint is " + fault_text(starts[i])});
  }
}

void read_all(const Json& json, Scene& scene, Problems& problems) {
  ObjectReader in(json, "", problems);
  if (!in.is_object() || !read_version(in, problems)) return;
  read_about(in, scene);
  read_camera(in, scene, problems);
  in.number("frame", kFrameRange, scene.frame, kOptional);
  const bool listed = read_effects(in, scene);
  in.vector("gravity", kGravityRange, scene.gravity, kOptional);
  read_contact(in, scene, problems);
  in.number("regularisation", kRegularisationRange, scene.regularisation, kOptional);
  read_start(in, scene);
  const bool has_settings = in.member("settings", kOptional) != nullptr;
  read_settings(in, scene.settings, problems);
  if (const Json* recommended = in.member("recommended", kOptional)) {
    scene.recommended = read_recommended(*recommended, in.pointer("recommended"), problems);
    if (!has_settings) scene.settings = scene.recommended->settings;
  }
  SoundParts sound;
  read_bodies(in, scene, sound, problems);
  const BodyNames names(scene.bodies, problems);
  read_criteria(in, names, scene, problems);
  scene.verdicts = read_verdicts(in, problems);
  read_joints(in, names, scene, sound, problems);
  scene.carried = read_carried(in, scene.bodies, problems);
  in.finish();

  if (listed) {
    check_listed_effects(in, scene, problems);
  } else {
    scene.effects = effects_of(scene);
  }
  check_joint_starts(scene, sound, problems);
  check_redundant_rows(scene, sound, problems);
  if (problems.empty() && scene.start == StartPolicy::kRefuse) check_refused(scene, problems);
}

}  // namespace

SceneResult read_scene(std::string_view text) {
  SceneResult result;
  Problems& problems = result.problems;
  const std::optional<Json> json = parse_json(text, problems);
  if (!json) return result;
  std::set<std::string> told;
  for (const Problem& problem : problems) told.insert(problem.pointer);

  auto scene = std::make_shared<Scene>();
  Problems found;
  read_all(*json, *scene, found);
  for (Problem& problem : found) {
    // Where the text itself was wrong, what stands there in its place is wrong again.
    if (!told.contains(problem.pointer)) problems.push_back(std::move(problem));
  }
  if (problems.size() > kMaxProblems) {
    problems.resize(kMaxProblems);
    problems.push_back({"", "and more: the rest of the file was not looked at"});
  }
  if (problems.empty()) result.scene = std::move(scene);
  return result;
}

SceneResult read_scene_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  constexpr std::size_t kPiece = 1U << 16U;  // [bytes]
  // To one byte more than allowed, so that read_scene sees that there is too much.
  while (file && text.size() <= kMaxTextSize) {
    const std::size_t before = text.size();
    text.resize(std::min(before + kPiece, kMaxTextSize + 1));
    file.read(&text[before], static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) {
    if (text.size() > kMaxTextSize) return read_scene(text);
    return {nullptr, {{"", "cannot read " + path + ": " + std::strerror(errno)}}};
  }
  return read_scene(text);
}

}  // namespace substep
