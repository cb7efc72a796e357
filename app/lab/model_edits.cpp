#include "app/lab/model_edits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/io/body_names.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/io/text_places.hpp"
#include "core/math/across.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/effects.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/types_in_files.hpp"

namespace substep {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kClear = 0.01;  // between a new body and others [m]

Json parsed(const std::string& text) {
  Problems problems;
  return parse_json(text, problems).value_or(Json());
}

/// A member of an object, or null.
Json* find(Json& object, std::string_view key) {
  auto* members = object.get_ptr<Json::object_t*>();
  if (members == nullptr) return nullptr;
  for (auto& [name, value] : *members) {
    if (name == key) return &value;
  }
  return nullptr;
}

void drop(Json& object, const char* key) { object.get_ptr<Json::object_t*>()->erase(key); }

Json::array_t& items_of(Json& list) { return *list.get_ptr<Json::array_t*>(); }

void drop(Json& list, std::size_t item) {
  auto& items = items_of(list);
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(item));
}

bool is_text(const Json* value, std::string_view text) {
  const auto* string = value == nullptr ? nullptr : value->get_ptr<const std::string*>();
  return string != nullptr && *string == text;
}

Json vector_of(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

std::string pointer_of(const char* list, std::size_t item, std::string_view key) {
  return '/' + std::string(list) + '/' + std::to_string(item) + '/' + std::string(key);
}

/// The value at a pointer, or null. @param last the last part of the pointer, not followed
Json* around(Json& json, std::string_view pointer, std::string& last) {
  Json* at = &json;
  while (at != nullptr && !pointer.empty()) {
    pointer.remove_prefix(1);
    last = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(last.size());
    if (pointer.empty()) break;
    if (at->is_object()) {
      at = find(*at, last);
    } else {
      const auto i = parse_integer(last);
      at = at->is_array() && i && *i >= 0 && static_cast<std::size_t>(*i) < at->size()
               ? &(*at)[static_cast<std::size_t>(*i)]
               : nullptr;
    }
  }
  return at;
}

/// The end of the value that begins at a byte of a valid text.
std::size_t end_of_value(const std::string& text, std::size_t at) {
  int depth = 0;
  for (bool quoted = false; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c == '\\') ++at;
      quoted = c != '"';
      if (!quoted && depth == 0) return at + 1;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      if (depth == 0) return at;
      if (--depth == 0) return at + 1;
    } else if (depth == 0 && std::string_view(" \t\r\n,").find(c) != std::string_view::npos) {
      return at;
    }
  }
  return at;
}

/// Adds effects that the change needs and the text does not list. @param before the change
std::string with_effects(const std::string& text, const Scene& before) {
  Json json = parsed(text);
  Json* listed = find(json, "effects");
  if (listed == nullptr) return text;
  Json bare = json;
  drop(bare, "effects");
  const auto after = read_scene(json_file(bare)).scene;
  if (after == nullptr) return text;  // its reader says why
  const Effects needed = effects_of(before);
  bool changed = false;
  for (const EffectEntry& effect : kEffects) {
    if (!(after->effects.*effect.member) || needed.*effect.member) continue;
    bool is_listed = false;
    for (const Json& name : items_of(*listed)) is_listed = is_listed || is_text(&name, effect.name);
    if (!is_listed) listed->push_back(Json(std::string(effect.name)));
    changed = changed || !is_listed;
  }
  return changed ? with_value(text, "/effects", *listed) : text;
}

/// The text of a changed document. What a saved run carries has an entry for each body.
std::string changed_text(Json json, const Scene& before) {
  drop(json, "carried");
  return with_effects(json_file(json), before);
}

template <class Items, class NameOf>
std::string free_name_of(const Items& items, std::string stem, NameOf name_of) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(items.begin(), items.end(),
                       [&](const auto& item) { return name_of(item) == name; });
  };
  // "link_3" continues "link_2"
  const std::size_t digits = stem.find_last_not_of("0123456789");
  if (digits != std::string::npos && stem[digits] == '_') stem.resize(digits);
  stem.resize(std::min<std::size_t>(stem.size(), 80));
  std::string name;
  for (int i = 1; is_taken(name = stem + '_' + std::to_string(i));) ++i;
  return name;
}

std::string free_body_name(const Scene& scene, const std::string& stem) {
  return free_name_of(scene.bodies, stem, [](const Body& body) { return body.name; });
}

bool is_plane(const Body& body) { return std::holds_alternative<Plane>(body.shape); }

Vec3 half_of(const Body& body) {
  return std::visit(
      [&](const auto& shape) { return shape.bounds(body.orientation.toRotationMatrix()); },
      body.shape);
}

/// Half extents along the axes of the body.
Vec3 extents_of(const Body& body) {
  const auto solid = outline(body.shape);
  return solid ? solid->half_extents : Vec3::Zero();
}

/// How far a body must be raised to be clear of another, by their bounding boxes [m]; 0 if it is.
double lift_over(const Body& body, const Body& other) {
  if (!body.collides || !other.collides) return 0.0;
  const Vec3 half = half_of(body);
  const Vec3 room = half_of(other);
  const Vec3 apart = body.position - other.position;
  const Vec3 up = other.orientation * Vec3::UnitY();
  double high = 0.0;  // of the body's lower side over a plane
  bool clear = false;
  constexpr double kTouch = 1e-9;
  for (int i = 0; i < 3; ++i) {
    high += up[i] * apart[i] - std::abs(up[i]) * half[i];
    clear = clear || std::abs(apart[i]) >= half[i] + room[i] - kTouch;
  }
  if (is_plane(other)) return high >= 0.0 || up.y() < 0.1 ? 0.0 : (kClear - high) / up.y();
  return clear ? 0.0 : half.y() + room.y() + kClear - apart.y();
}

/// @param except a body that it may touch, or kWorld
bool is_clear(const Scene& scene, const Body& body, int except) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (static_cast<int>(i) != except && lift_over(body, scene.bodies[i]) > 0.0) return false;
  }
  return true;
}

/// Raises a body until it is clear of all others.
void raise(const Scene& scene, Body& body) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double lift = lift_over(body, scene.bodies[i]);
    if (lift <= 0.0) continue;
    body.position.y() += lift;
    i = static_cast<std::size_t>(-1);  // it may meet those before
  }
}

/// The rotation that takes x to a unit vector.
Quat from_x_to(const Vec3& to) {
  constexpr double kOpposite = 1e-9;
  if (1.0 + to.x() < kOpposite) return {0.0, 0.0, 0.0, 1.0};
  const Vec3 axis = Vec3::UnitX().cross(to);
  return Quat(1.0 + to.x(), axis.x(), axis.y(), axis.z()).normalized();
}

/// A place for a joint on a body, and the direction out of it, both in its frame.
struct End {
  Vec3 point = Vec3::Zero();
  Vec3 out = Vec3::UnitX();
};

std::vector<Vec3> anchors_on(const Scene& scene, int body) {
  std::vector<Vec3> anchors;
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    if (j.a == body) anchors.push_back(j.anchor_a);
    if (j.b == body) anchors.push_back(j.anchor_b);
  }
  return anchors;
}

/// The middles of its faces, the longest axis first; of a ball along its axes too.
std::vector<End> ends_of(const Body& body) {
  const Vec3 half = extents_of(body);
  int longest = 0;
  for (int i = 1; i < 3; ++i) longest = half[i] > half[longest] ? i : longest;
  std::vector<End> ends(6);
  for (int i = 0; i < 6; ++i) {
    const int axis = (longest + i / 2) % 3;
    End& end = ends[index(i)];
    end.out = Vec3::Zero();
    end.out[axis] = i % 2 == 0 ? 1.0 : -1.0;
    end.point[axis] = end.out[axis] * half[axis];
  }
  return ends;
}

/// The end that is farthest from the body's joints.
End free_end(const Scene& scene, int body) {
  const std::vector<Vec3> used = anchors_on(scene, body);
  const std::vector<End> ends = ends_of(scene.bodies[index(body)]);
  const auto room = [&](const End& end) {
    double least = used.empty() ? 0.0 : 1e300;
    for (const Vec3& anchor : used) least = std::min(least, (end.point - anchor).norm());
    return least;
  };
  const End* best = ends.data();
  for (const End& end : ends) {
    if (room(end) > room(*best) + 1e-9) best = &end;
  }
  return *best;
}

/// A direction across another, along an axis of the world if possible.
Vec3 across_of_direction(const Vec3& along) {
  const Vec3 first = std::abs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitY();
  return (first - along * along.dot(first)).normalized();
}

/// @param on_a, on_b where the joint holds them, world [m] @param along a direction between them
Json joint_between(Scene scene, int a, int b, std::size_t type, const Vec3& on_a, const Vec3& on_b,
                   const Vec3& along) {
  const std::string name =
      free_name_of(scene.joints, "joint", [](const Joint& joint) { return base(joint).name; });
  SceneBuilder builder;
  builder.scene() = std::move(scene);
  const Vec3 middle = 0.5 * (on_a + on_b);
  const Vec3 across = across_of_direction(along);
  const std::string_view kind = kTypes<Joint>[type];
  int joint = 0;
  if (kind == BallJoint::kType) joint = builder.add_ball_joint(a, b, middle);
  if (kind == HingeJoint::kType) joint = builder.add_hinge(a, b, middle, across);
  if (kind == PrismaticJoint::kType) joint = builder.add_prismatic(a, b, middle, along);
  if (kind == WeldJoint::kType) joint = builder.add_weld(a, b, middle);
  if (kind == DistanceJoint::kType) joint = builder.add_distance(a, b, on_a, on_b);
  if (kind == UniversalJoint::kType) {
    joint = builder.add_universal(a, b, middle, across, along.cross(across));
  }
  if (kind == CylindricalJoint::kType) joint = builder.add_cylindrical(a, b, middle, along);
  if (kind == RopeJoint::kType) {
    joint = builder.add_rope(a, b, on_a, on_b, std::max((on_a - on_b).norm(), 0.1));
  }
  builder.joint(joint).name = name;
  return joint_json(builder.scene(), builder.scene().joints[index(joint)]);
}

/// Whether a joint of this type keeps its bodies apart.
bool is_long(std::size_t type) {
  const std::string_view kind = kTypes<Joint>[type];
  return kind == DistanceJoint::kType || kind == RopeJoint::kType;
}

Body new_part(const Scene& scene, BodyPart part, int like) {
  Body body;
  body.mass = part == BodyPart::kLink ? 1.0 : 10.0;
  body.friction = 0.5;
  const char* stem = "box";
  body.shape = Box{{0.25, 0.25, 0.25}};
  if (part == BodyPart::kBall) {
    stem = "ball";
    body.shape = Sphere{0.25};
  } else if (part == BodyPart::kLink) {
    stem = "link";
    body.shape = Box{{0.25, 0.05, 0.05}};
    const Body* last = like == kWorld ? nullptr : &scene.bodies[index(like)];
    const auto* box = last != nullptr ? std::get_if<Box>(&last->shape) : nullptr;
    if (box != nullptr && !last->is_static &&
        box->half_extents.x() > 2.0 * box->half_extents.tail<2>().maxCoeff()) {
      body = *last;
      body.velocity = body.angular_velocity = body.force = body.torque = Vec3::Zero();
      stem = last->name.c_str();
    }
  }
  body.name = free_body_name(scene, stem);
  body.inertia = solid_inertia(body.shape, body.mass);
  return body;
}

/// Renames a body in joints and criteria, or drops the criteria about it if `to` is empty.
void rename(Json& json, const std::string& from, const std::string& to) {
  if (Json* joints = find(json, "joints")) {
    for (Json& joint : items_of(*joints)) {
      for (const char* side : {"a", "b"}) {
        if (Json* body = find(joint, side); is_text(body, from)) *body = to;
      }
    }
  }
  Json* criteria = find(json, "criteria");
  if (criteria == nullptr) return;
  if (Json* track = find(*criteria, "track"); is_text(track, from)) {
    *track = to;
    if (to.empty()) drop(*criteria, "track");
  }
  Json* moved = find(*criteria, "displacement");
  if (moved == nullptr) return;
  if (Json* body = find(*moved, "body"); is_text(body, from)) {
    *body = to;
    if (to.empty()) drop(*criteria, "displacement");
  }
}

struct Unit {
  std::string_view key;
  const char* name;
};
constexpr Unit kUnits[] = {
    {"mass", "kg"},        {"size", "m"},        {"radius", "m"},
    {"position", "m"},     {"orientation", "°"}, {"velocity", "m/s"},
    {"force", "N"},        {"torque", "N m"},    {"angular_velocity", "rad/s"},
    {"inertia", "kg m²"},  {"anchor_a", "m"},    {"anchor_b", "m"},
    {"compliance", "m/N"}, {"length", "m"},      {"angular_compliance", "rad/N m"},
    {"gravity", "m/s²"},   {"frame", "s"}};

/// Lists fields as the values of an object.
struct FieldList {
  std::vector<ModelField>& fields;
  std::string pointer;  // of the object, with a slash
  std::string prefix;   // of names

  void add(const std::string& key, std::vector<std::string> values) const {
    ModelField& field = fields.emplace_back();
    field.name = prefix + key;
    std::replace(field.name.begin(), field.name.end(), '_', ' ');
    field.pointer = pointer + key;
    for (const Unit& unit : kUnits) {
      if (unit.key == key && prefix.empty()) field.unit = unit.name;
    }
    field.values = std::move(values);
  }
  void add(const std::string& key, double number) const { add(key, {number_text(number)}); }
  void add(const std::string& key, const Vec3& v) const {
    add(key, {number_text(v.x()), number_text(v.y()), number_text(v.z())});
  }
  /// Numbers of an object, also those within its objects.
  void add_all(const Json& object) const {
    for (const auto& [key, value] : *object.get_ptr<const Json::object_t*>()) {
      if (value.is_object()) {
        FieldList{fields, pointer + key + '/', key + ' '}.add_all(value);
      } else if (const auto* number = value.get_ptr<const double*>()) {
        add(key, *number);
      } else if (value.is_array()) {
        std::vector<std::string> values;
        for (const Json& each : *value.get_ptr<const Json::array_t*>())
          values.push_back(number_text(*each.get_ptr<const double*>()));
        add(key, std::move(values));
      }
    }
  }
};

}  // namespace

std::string new_scene_text(const std::string& name, const std::string& title) {
  Json json = parsed(R"({"format": "substep-scene", "version": 2, "name": "", "title": "",
    "camera": {"eye": [1, 3.4, 9], "target": [0, 2.8, 0], "width": 7},
    "effects": ["gravity", "gyroscopic", "joints", "contact", "friction"],
    "bodies": [{"name": "floor", "static": true, "shape": {"type": "plane"},
                "position": [0, 0, 0], "friction": 0.5}]})");
  json["name"] = name;
  json["title"] = title;
  return json_file(json);
}

std::string with_value(const std::string& text, const std::string& pointer, const Json& value) {
  Json json = parsed(text);
  std::string key;
  Json* object = around(json, pointer, key);
  if (object == nullptr) return text;
  const bool is_item = object->is_array();
  if (!is_item && find(*object, key) == nullptr) {
    if (!value.is_null()) (*object)[key] = value;
    return json_file(json);
  }
  if (value.is_null()) {
    if (!is_item) drop(*object, key.c_str());
    return json_file(json);
  }
  std::size_t at = offset_of(text, places_of({{pointer, ""}}, text).front());
  if (!is_item) {  // the place is that of the key
    at = text.find(':', end_of_value(text, at)) + 1;
    at = text.find_first_not_of(" \t\r\n", at);
  }
  std::string printed = json_file(value);
  printed.pop_back();  // the line break
  return text.substr(0, at) + printed + text.substr(end_of_value(text, at));
}

std::vector<ModelField> fields_of_body(const Scene& scene, int body) {
  const auto i = index(body);
  const Body& b = scene.bodies[i];
  std::vector<ModelField> fields;
  const FieldList list{fields, pointer_of("bodies", i, ""), ""};
  if (!b.is_static) list.add("mass", b.mass);
  Json json = body_json(b);
  FieldList{fields, pointer_of("bodies", i, "shape/"), ""}.add_all(json["shape"]);
  list.add("position", b.position);
  const Quat& q = b.orientation;
  const double sine = std::hypot(q.x(), q.y(), q.z());
  const double per_sine = sine > 0.0 ? 2.0 * std::atan2(sine, q.w()) * kDegrees / sine : 0.0;
  const auto degrees = [&](double part) { return std::round(1e6 * per_sine * part) / 1e6 + 0.0; };
  list.add("orientation", Vec3(degrees(q.x()), degrees(q.y()), degrees(q.z())));
  if (!b.is_static) {
    for (const MotionField& field : kMotionFields) list.add(field.key, b.*field.member);
  }
  list.add("friction", b.friction);
  list.add("restitution", b.restitution);
  if (!b.is_static) list.add("inertia", b.inertia);
  list.add("name", {b.name});
  return fields;
}

std::vector<ModelField> fields_of_joint(const Scene& scene, std::size_t joint) {
  std::vector<ModelField> fields;
  const FieldList list{fields, pointer_of("joints", joint, ""), ""};
  list.add_all(joint_json(scene, scene.joints[joint]));
  list.add("name", {base(scene.joints[joint]).name});
  return fields;
}

std::vector<ModelField> fields_of_scene(const Scene& scene) {
  std::vector<ModelField> fields;
  const FieldList list{fields, "/", ""};
  list.add("title", {scene.title});
  if (scene.effects.gravity) list.add("gravity", scene.gravity);
  list.add("frame", scene.frame);
  return fields;
}

std::string with_typed(const std::string& text, const Scene& scene, const ModelField& field,
                       std::size_t part, const std::string& typed) {
  Json json = parsed(text);
  std::string key;
  Json* object = around(json, field.pointer, key);
  if (object == nullptr) return text;
  const bool is_body = field.pointer.starts_with("/bodies/");
  const bool is_name = key == "name" || key == "title";
  if (is_body && key == "name") {
    rename(json, field.values[0], typed);
    (*object)[key] = typed;
    return json_file(json);
  }
  const auto number_of = [&](const std::string& from) {
    const auto number = is_name ? std::nullopt : parse_number(from);
    return number ? Json(*number) : Json(from);
  };
  std::vector<std::string> values = field.values;
  values[part] = typed;
  Json value = number_of(typed);
  std::string pointer = field.pointer;
  if (typed.empty() && !is_name) {
    value = nullptr;
  } else if (key == "orientation") {
    std::array<double, 3> turn{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto degrees = parse_number(values[i]);
      if (!degrees) return with_value(text, pointer, value);
      turn[i] = *degrees / kDegrees;
    }
    const double angle = std::hypot(turn[0], turn[1], turn[2]);
    const double share = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.0;
    value = Json::array({std::cos(0.5 * angle), share * turn[0], share * turn[1], share * turn[2]});
  } else if (values.size() > 1) {
    if (find(*object, key) != nullptr) {
      pointer += '/' + std::to_string(part);
    } else {
      value = Json::array();
      for (const std::string& each : values) value.push_back(number_of(each));
    }
  }
  std::string changed = with_value(text, pointer, value);
  // Velocities that a saved run carries would replace the new ones.
  if (is_body && find(json, "carried") != nullptr)
    changed = with_value(changed, "/carried", nullptr);
  return with_effects(changed, scene);
}

std::string with_body(const std::string& text, const Scene& scene, BodyPart part, int near,
                      const std::optional<Hold>& hold) {
  Json json = parsed(text);
  Scene all = scene;
  Body body = new_part(scene, part, hold ? hold->by : near);
  const int added = static_cast<int>(scene.bodies.size());
  if (!hold) {
    body.orientation = Quat::Identity();
    if (near != kWorld && !is_plane(scene.bodies[index(near)])) {
      body.position = scene.bodies[index(near)].position;
    } else {
      body.position.setZero();
    }
    raise(scene, body);
    json["bodies"].push_back(body_json(body));
    return changed_text(std::move(json), scene);
  }
  const int by = hold->by;
  Vec3 point(0.0, 4.0, 0.0);  // of the world
  Vec3 out = Vec3::UnitX();
  Quat q = Quat::Identity();
  const bool on_body = by != kWorld && !is_plane(scene.bodies[index(by)]);
  if (on_body) {
    const Body& holder = scene.bodies[index(by)];
    const End end = free_end(scene, by);
    q = holder.orientation * from_x_to(end.out);
    point = holder.position + holder.orientation * end.point;
    out = holder.orientation * end.out;
  }
  const double apart = is_long(hold->type) ? 0.5 : 0.0;
  const auto place = [&](const Vec3& along, const Quat& turned) {
    const bool round = std::holds_alternative<Sphere>(body.shape);
    body.orientation = round ? Quat(Quat::Identity()) : turned;
    body.position = point + (apart + extents_of(body).x()) * along;
    return is_clear(scene, body, by);
  };
  bool clear = place(out, q);
  for (int tries = 0; !clear && !on_body && tries < 20; ++tries) {
    point.y() += 0.5;
    clear = place(out, q);
  }
  for (const Vec3& along : {Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 1, 0)}) {
    if (clear) break;
    clear = place(along, from_x_to(along));
    if (clear) out = along;
  }
  if (!clear) place(out, q);
  all.bodies.push_back(body);
  json["bodies"].push_back(body_json(body));
  json["joints"].push_back(joint_between(all, added, on_body ? by : kWorld, hold->type,
                                         point + apart * out, point, out));
  return changed_text(std::move(json), scene);
}

std::string with_copy(const std::string& text, const Scene& scene, int body) {
  Json json = parsed(text);
  Body copy = scene.bodies[index(body)];
  Json item = json["bodies"][index(body)];
  item["name"] = copy.name = free_body_name(scene, copy.name);
  copy.position.x() += 2.0 * half_of(copy).x() + 0.1;
  if (!is_plane(copy)) raise(scene, copy);
  item["position"] = vector_of(copy.position);
  json["bodies"].push_back(std::move(item));
  return changed_text(std::move(json), scene);
}

std::string without_body(const std::string& text, const Scene& scene, int body) {
  Json json = parsed(text);
  drop(json["bodies"], index(body));
  for (std::size_t j = scene.joints.size(); j-- > 0;) {
    const JointBase& joint = base(scene.joints[j]);
    if (joint.a == body || joint.b == body) drop(json["joints"], j);
  }
  rename(json, scene.bodies[index(body)].name, "");
  return changed_text(std::move(json), scene);
}

std::string without_joint(const std::string& text, std::size_t joint) {
  Json json = parsed(text);
  drop(json["joints"], joint);
  drop(json, "carried");
  return json_file(json);
}

std::string with_joint(const std::string& text, const Scene& scene, int a, int b,
                       std::size_t type) {
  Json json = parsed(text);
  if (a == kWorld || scene.bodies[index(a)].is_static) std::swap(a, b);
  const auto points = [&](int body) {
    std::vector<Vec3> all;
    if (body == kWorld || is_plane(scene.bodies[index(body)])) return all;
    const Body& of = scene.bodies[index(body)];
    for (const End& end : ends_of(of)) all.emplace_back(of.position + of.orientation * end.point);
    return all;
  };
  const std::vector<Vec3> of_a = points(a);
  const std::vector<Vec3> of_b = points(b);
  Vec3 on_a = of_a.empty() ? Vec3(Vec3::Zero()) : of_a.front();
  if (!of_a.empty() && of_b.empty()) {
    const Body& body = scene.bodies[index(a)];
    on_a = body.position + body.orientation * free_end(scene, a).point;
  }
  Vec3 on_b = on_a;
  double least = 1e300;
  for (const Vec3& p : of_a) {
    for (const Vec3& q : of_b) {
      if ((p - q).norm() >= least - 1e-9) continue;
      least = (p - q).norm();
      on_a = p;
      on_b = q;
    }
  }
  if (is_long(type) && of_b.empty()) on_b += Vec3(0.0, 0.5, 0.0);
  const Vec3 between =
      a == kWorld ? Vec3(Vec3::UnitX()) : Vec3(scene.bodies[index(a)].position - on_b);
  const Vec3 along = between.norm() > 1e-6 ? Vec3(between.normalized()) : Vec3(Vec3::UnitX());
  json["joints"].push_back(joint_between(scene, a, b, type, on_a, on_b, along));
  return changed_text(std::move(json), scene);
}

std::string with_motion(const std::string& text, const Scene& scene, int body, bool moves) {
  Json json = parsed(text);
  Json& item = json["bodies"][index(body)];
  const Body& b = scene.bodies[index(body)];
  if (moves) {
    constexpr double kWater = 1000.0;  // [kg/m^3]
    const Vec3 size = 2.0 * extents_of(b);
    drop(item, "static");
    item["mass"] = three_digits(std::max(kWater * size.prod(), 1e-6));
  } else {
    for (const char* key : {"mass", "inertia", "velocity", "angular_velocity", "force", "torque"}) {
      drop(item, key);
    }
    item["static"] = true;
  }
  return changed_text(std::move(json), scene);
}

}  // namespace substep
