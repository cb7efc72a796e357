#include "core/io/scene_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/io/body_names.hpp"
#include "core/io/carried_json.hpp"
#include "core/io/json.hpp"
#include "core/io/recommended_json.hpp"
#include "core/io/settings_json.hpp"
#include "core/io/verdicts_json.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/format_text.hpp"
#include "core/model/names.hpp"
#include "core/model/types_in_files.hpp"

namespace substep {
namespace {

Json vector_json(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

struct ShapeFieldWriter {
  Json& json;

  void operator()(const char* key, double number, const Range&, double factor) const {
    json[key] = factor * number;
  }
  void operator()(const char* key, const Vec3& numbers, const Range&, double factor) const {
    json[key] = vector_json(factor * numbers);
  }
};

Json shape_json(const Shape& shape) {
  Json json;
  json["type"] = kTypes<Shape>[shape.index()];
  std::visit([&](const auto& own) { own.own_fields(own, ShapeFieldWriter{json}); }, shape);
  return json;
}

/// Writes directions and optional parts at once, and numbers to where the compliance comes first.
struct OwnFieldWriter {
  Json& axes;
  Json& numbers;

  void operator()(const char* key, const Vec3& axis) const { axes[key] = vector_json(axis); }
  void operator()(const char* key, double number, const Range&) const { numbers[key] = number; }
  void operator()(const char* key, const std::optional<double>& number, const Range&) const {
    if (number) numbers[key] = *number;
  }
  template <class Part>
  void operator()(const char* key, const std::optional<Part>& part) const {
    if (!part) return;
    Json json;
    Part::own_fields(*part, OwnFieldWriter{json, json});
    numbers[key] = std::move(json);
  }
};

/// @param body index, or kWorld
std::string name_of_body(const Scene& scene, int body) {
  if (body == kWorld) return std::string(kWorldName);
  return body_fault(scene.bodies, body) ? "" : scene.bodies[index(body)].name;
}

Json criteria_json(const Scene& scene) {
  const Criteria& c = scene.criteria;
  Json json;
  json["duration"] = c.duration;
  if (c.joint_gap) json["joint_gap"] = *c.joint_gap;
  if (c.energy_gain == kAnyEnergy) {
    json["energy_gain"] = kAnyGain;
  } else if (c.energy_gain) {
    json["energy_gain"] = *c.energy_gain;
  }
  if (c.energy_scale) json["energy_scale"] = *c.energy_scale;
  if (c.displacement) {
    json["displacement"] = {{"body", name_of_body(scene, c.displacement->body)},
                            {"distance", c.displacement->distance}};
  }
  if (c.track) json["track"] = name_of_body(scene, *c.track);
  if (c.window) json["window"] = *c.window;
  json["expected"] = c.holds ? "holds" : "fails";
  return json;
}

/// Whether every reference to a body can be written: as a name.
bool has_named_bodies(const Scene& scene) {
  const auto is_body = [&](int body) { return !body_fault(scene.bodies, body); };
  const Criteria& c = scene.criteria;
  if (c.displacement && !is_body(c.displacement->body)) return false;
  if (c.track && !is_body(*c.track)) return false;
  return std::all_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& joint) {
    const JointBase& j = base(joint);
    return (j.a == kWorld || is_body(j.a)) && (j.b == kWorld || is_body(j.b));
  });
}

/// JSON has no other numbers.
bool is_finite(const Json& json) {
  if (json.is_structured()) return std::all_of(json.begin(), json.end(), is_finite);
  return !json.is_number_float() || std::isfinite(json.get<double>());
}

Json scene_json(const Scene& scene) {
  Json json;
  json["format"] = "substep-scene";
  json["version"] = kSceneVersion;
  json["name"] = scene.name;
  json["title"] = scene.title;
  json["group"] = scene.group;
  json["description"] = scene.description;
  json["look_for"] = scene.look_for;
  json["camera"] = {{"eye", vector_json(scene.camera.eye)},
                    {"target", vector_json(scene.camera.target)}};
  if (scene.camera.width) json["camera"]["width"] = *scene.camera.width;
  json["frame"] = scene.frame;
  Json& effects = json["effects"] = Json::array();
  for (const EffectEntry& effect : kEffects) {
    if (scene.effects.*effect.member) effects.push_back(effect.name);
  }
  if (scene.effects.gravity) json["gravity"] = vector_json(scene.gravity);
  if (scene.effects.contact) {
    Json& contact = json["contact"];
    contact["compliance"] = scene.contact.compliance;
    if (scene.effects.friction) contact["friction_compliance"] = scene.contact.friction_compliance;
    contact["margin"] = scene.contact.margin;
    if (scene.effects.restitution) contact["restitution_speed"] = scene.contact.restitution_speed;
    if (scene.contact.soft_compliance != ContactModel{}.soft_compliance) {
      contact["soft_compliance"] = scene.contact.soft_compliance;
    }
  }
  if (scene.regularisation != 0.0) json["regularisation"] = scene.regularisation;
  if (scene.start != StartPolicy::kProject) json["start"] = name_of(scene.start);
  // A scene without settings starts with the recommended ones.
  if (!scene.recommended || scene.settings != scene.recommended->settings) {
    json["settings"] = scene_settings_json(scene.settings);
  }
  if (scene.recommended) json["recommended"] = recommended_json(*scene.recommended);
  json["criteria"] = criteria_json(scene);
  if (!scene.verdicts.empty()) json["verdicts"] = verdicts_json(scene.verdicts);
  Json& bodies = json["bodies"] = Json::array();
  for (const Body& body : scene.bodies) bodies.push_back(body_json(body));
  if (!scene.joints.empty()) {
    Json& joints = json["joints"] = Json::array();
    for (const Joint& joint : scene.joints) joints.push_back(joint_json(scene, joint));
  }
  if (scene.carried) json["carried"] = carried_json(*scene.carried, scene.bodies);
  return json;
}

}  // namespace

Json body_json(const Body& body) {
  Json json;
  json["name"] = body.name;
  if (body.is_static) json["static"] = true;
  json["shape"] = shape_json(body.shape);
  if (!body.is_static) {
    json["mass"] = body.mass;
    if (body.inertia != solid_inertia(body.shape, body.mass)) {
      json["inertia"] = vector_json(body.inertia);
    }
  }
  json["position"] = vector_json(body.position);
  const Quat& q = body.orientation;
  if (q.coeffs() != Quat::Identity().coeffs()) {
    json["orientation"] = Json::array({q.w(), q.x(), q.y(), q.z()});
  }
  for (const MotionField& field : kMotionFields) {
    if (body.*field.member != Vec3::Zero()) json[field.key] = vector_json(body.*field.member);
  }
  if (body.friction != 0.0) json["friction"] = body.friction;
  if (body.restitution != 0.0) json["restitution"] = body.restitution;
  if (body.collision_group >= 0) json["collision_group"] = body.collision_group;
  if (!body.collides) json["collides"] = false;
  if (body.color) json["color"] = format_text("#%06x", *body.color & 0xffffffU);
  return json;
}

Json joint_json(const Scene& scene, const Joint& joint) {
  const JointBase& j = base(joint);
  Json json;
  json["name"] = j.name;
  json["type"] = kTypes<Joint>[joint.index()];
  json["a"] = name_of_body(scene, j.a);
  json["b"] = name_of_body(scene, j.b);
  json["anchor_a"] = vector_json(j.anchor_a);
  json["anchor_b"] = vector_json(j.anchor_b);
  Json numbers;
  numbers["compliance"] = j.compliance;
  std::visit([&](const auto& own) { own.own_fields(own, OwnFieldWriter{json, numbers}); }, joint);
  json.update(numbers);
  return json;
}

std::string write_scene(const Scene& scene) {
  if (!has_named_bodies(scene)) return "";
  const Json json = scene_json(scene);
  return is_finite(json) ? json_file(json) : "";
}

}  // namespace substep
