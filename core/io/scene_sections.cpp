#include "core/io/scene_sections.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/model/scene_checks.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {

std::optional<int> read_version(ObjectReader& in, Problems& problems) {
  const std::size_t before = problems.size();
  std::string format;
  if (in.text("format", kMaxProse, format, kRequired) && format != "substep-scene") {
    in.problem("format", must_be("\"substep-scene\"", value_text(format)));
  }
  int version = 0;
  in.integer("version", 1, kSceneVersion, version, kRequired);
  return problems.size() == before ? std::optional(version) : std::nullopt;
}

void read_about(ObjectReader& in, Scene& scene) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_-";
  if (in.text("name", kMaxNameSize, scene.name, kRequired) &&
      scene.name.find_first_not_of(kLetters) != std::string::npos) {
    in.problem("name", must_be("made of a-z, 0-9, _ and -", value_text(scene.name)));
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
    in.problem("target", "must be a different point from eye");
  }
  double width = 0.0;
  if (in.number("width", kDistanceRange, width, kOptional)) scene.camera.width = width;
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
  in.number("soft_compliance", kComplianceRange, scene.contact.soft_compliance, kOptional);
  in.finish();
}

void read_criteria(ObjectReader& parent, const BodyNames& names, Scene& scene, Problems& problems) {
  const Json* json = parent.member("criteria", kOptional);
  if (!json) return;
  ObjectReader in(*json, parent.pointer("criteria"), problems);
  Criteria& criteria = scene.criteria;
  double value = 0.0;
  in.number("duration", kDurationRange, criteria.duration, kOptional);
  if (in.number("joint_gap", kDistanceRange, value, kOptional)) criteria.joint_gap = value;
  if (const Json* gain = in.member("energy_gain", kOptional); gain && *gain == kAnyGain) {
    criteria.energy_gain = kAnyEnergy;
  } else if (in.number("energy_gain", kEnergyRange, value, kOptional)) {
    criteria.energy_gain = value;
  }
  if (in.number("energy_scale", kEnergyRange, value, kOptional)) criteria.energy_scale = value;
  if (in.number("window", kDurationRange, value, kOptional)) criteria.window = value;
  const auto read_body_name = [&](ObjectReader& reader, std::string_view key, Presence presence) {
    auto body = names.read(reader, key, presence);
    if (body == kWorld) {
      reader.problem(key, "must be a body of the scene, not \"world\"");
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
  constexpr std::string_view kOutcomes[] = {"holds", "fails"};
  const auto expected = in.choice("expected", kOutcomes, kOptional);
  criteria.holds = !expected || kOutcomes[*expected] == "holds";
  in.finish();
}

bool read_effects(ObjectReader& in, Scene& scene) {
  const Json* list = in.list("effects", 100, kOptional);
  if (!list) return in.member("effects", kOptional) != nullptr;
  std::vector<std::string_view> names;
  for (const EffectEntry& effect : kEffects) names.push_back(effect.name);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& name = (*list)[i];
    const auto found = std::find_if(kEffects.begin(), kEffects.end(),
                                    [&](const EffectEntry& effect) { return name == effect.name; });
    if (found == kEffects.end()) {
      in.item_problem("effects", i, must_be(one_of(names), value_text(name)));
    } else if (scene.effects.*found->member) {
      in.item_problem("effects", i, value_text(name) + " is listed twice");
    } else {
      scene.effects.*found->member = true;
    }
  }
  return true;
}

void check_listed_effects(ObjectReader& in, const Scene& scene, Problems& problems) {
  const Effects& listed = scene.effects;
  const auto missing = [&](std::string_view effect, const std::string& why) {
    in.problem("effects", value_text(effect) + " is missing, but " + why);
  };
  if (!listed.gravity && in.member("gravity", kOptional)) missing("gravity", "/gravity is given");
  if (!listed.contact && in.member("contact", kOptional)) missing("contact", "/contact is given");
  check_effects(scene, problems);
}

void read_start(ObjectReader& in, Scene& scene) {
  scene.start = in.choice<StartPolicy>("start", kOptional).value_or(scene.start);
}

}  // namespace substep
