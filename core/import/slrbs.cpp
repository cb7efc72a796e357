#include "core/import/slrbs.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include "core/import/mass_properties.hpp"
#include "core/import/scene_names.hpp"
#include "core/import/solid.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

class SlrbsReader {
 public:
  SlrbsReader(const Json& json, const ImportOptions& options, ImportReport& report,
              ScenePlaces& places)
      : json_(json), options_(options), report_(report), places_(places) {}

  Scene read() {
    ObjectReader in(json_, "", problems_);
    std::string name = "scene";
    in.text("name", kMaxTitle, name, kOptional);
    in.text("description", kMaxProse, builder_.scene().description, kOptional);
    in.member("version", kOptional);
    const Json* bodies = in.list("bodies", kMaxBodies, kRequired);
    const Json* joints = in.list("joints", kMaxJoints, kOptional);
    for (std::size_t i = 0; bodies != nullptr && i < bodies->size(); ++i) {
      read_body((*bodies)[i], pointer_to("/bodies", i));
    }
    for (std::size_t i = 0; joints != nullptr && i < joints->size(); ++i) {
      read_joint((*joints)[i], pointer_to("/joints", i));
    }
    read_physics(in);
    list_others(in);
    for (const Problem& problem : problems_) report_.errors.add(problem.pointer, problem.message);
    Scene& scene = builder_.scene();
    scene.name = identifier_of(name);
    scene.title = text_within(name, kMaxTitle);
    scene.group = "imported";
    report_.came_in.push_back("bodies: " + std::to_string(scene.bodies.size()));
    report_.came_in.push_back("joints: " + std::to_string(scene.joints.size()));
    return *builder_.build();
  }

 private:
  /// Keys that are not read.
  void list_others(ObjectReader& in) {
    const std::size_t before = problems_.size();
    in.finish();
    for (std::size_t i = before; i < problems_.size(); ++i) {
      report_.left_out.add(problems_[i].pointer, "a key that is not read");
    }
    problems_.resize(before);
  }

  bool vector(ObjectReader& in, const char* key, const Range& range, Vec3& target,
              Presence presence) {
    const Json* member = in.member(key, presence);
    if (member == nullptr) return false;
    ObjectReader parts = in.inner(key, *member);
    const std::size_t before = problems_.size();
    constexpr const char* kAxes[] = {"x", "y", "z"};
    Vec3 read = target;
    for (int i = 0; i < 3; ++i) parts.number(kAxes[i], range, read[i], kRequired);
    if (problems_.size() > before) return false;
    target = read;
    return true;
  }

  Quat orientation(ObjectReader& in, const char* key) {
    const Json* member = in.member(key, kOptional);
    if (member == nullptr) return Quat::Identity();
    ObjectReader parts = in.inner(key, *member);
    constexpr const char* kParts[] = {"w", "x", "y", "z"};
    std::array<double, 4> q{1.0, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 4; ++i) {
      parts.number(kParts[i], symmetric(1e3, "-"), q[i], kRequired);
    }
    const Quat turn(q[0], q[1], q[2], q[3]);
    if (turn.norm() > 1e-10) return turn.normalized();
    in.problem(key, "the quaternion has length 0");
    return Quat::Identity();
  }

  void read_body(const Json& json, const std::string& pointer) {
    ObjectReader in(json, pointer, problems_);
    int id = 0;
    in.integer("id", 0, 1'000'000'000, id, kRequired);
    bool is_fixed = false;
    in.flag("fixed", is_fixed, kOptional);
    double mass = 1.0;
    in.number("mass", kMassRange, mass, is_fixed ? kOptional : kRequired);
    Vec3 position = Vec3::Zero();
    vector(in, "position", kPositionRange, position, kRequired);
    std::optional<Solid> solid;
    bool is_cylinder = false;
    const Shape shape = read_shape(in, pointer, mass, solid, is_cylinder);
    const int i =
        is_fixed ? builder_.add_fixed(shape, position) : builder_.add_body(shape, mass, position);
    Body& body = builder_.body(i);
    body.name = names_.unique("body_" + std::to_string(id));
    places_.bodies.push_back(pointer);
    if (!bodies_.emplace(id, i).second) in.problem("id", "another body has this id");
    body.orientation = orientation(in, "orientation");
    if (!is_fixed && solid) body.inertia = own_inertia(*solid, mass);
    vector(in, "linear_velocity", kVelocityRange, body.velocity, kOptional);
    vector(in, "angular_velocity", kAngularVelocityRange, body.angular_velocity, kOptional);
    body.collides = options_.collide && !is_cylinder;
    list_others(in);
  }

  /// A cylinder's axis is y here, and z in Solid.
  static Vec3 own_inertia(const Solid& solid, double mass) {
    const Vec3 moments = mass_properties(solid, mass).inertia.diagonal();
    return {moments.x(), moments.z(), moments.y()};
  }

  /// @param solid set if its inertia is not that of the shape
  Shape read_shape(ObjectReader& in, const std::string& pointer, double mass,
                   std::optional<Solid>& solid, bool& is_cylinder) {
    const Json* member = in.member("geometry", kRequired);
    if (member == nullptr) return Sphere{};
    ObjectReader geometry = in.inner("geometry", *member);
    constexpr std::string_view kKinds[] = {"box", "sphere", "cylinder"};
    const auto kind = geometry.choice("type", kKinds, kRequired);
    if (!kind) return Sphere{};
    if (*kind == 0) {
      Vec3 size = Vec3::Ones();
      vector(geometry, "dimensions", kSizeRange, size, kRequired);
      list_others(geometry);
      return Box{0.5 * size};
    }
    double radius = 1.0;
    geometry.number("radius", kSizeRange, radius, kRequired);
    if (*kind == 1) {
      list_others(geometry);
      return Sphere{radius};
    }
    is_cylinder = true;
    double height = 1.0;
    geometry.number("height", kSizeRange, height, kRequired);
    list_others(geometry);
    solid = Solid{Solid::Kind::kCylinder, Vec3(radius, radius, 0.5 * height)};
    report_.approximated.add(pointer,
                             "a cylinder is drawn as the box of its inertia and does not collide");
    return Box{equivalent_box(mass, own_inertia(*solid, mass))};
  }

  void read_joint(const Json& json, const std::string& pointer) {
    ObjectReader in(json, pointer, problems_);
    constexpr std::string_view kKinds[] = {"hinge", "spherical"};
    const auto kind = in.choice("type", kKinds, kRequired);
    int id = 0;
    in.integer("id", 0, 1'000'000'000, id, kOptional);
    struct Side {
      int body = kWorld;
      Vec3 anchor = Vec3::Zero();
      Vec3 axis = Vec3::UnitX();
    };
    std::array<Side, 2> sides;
    bool has_bodies = true;
    // The reader keeps references to the keys.
    struct Keys {
      const char *id, *offset, *orientation;
    };
    constexpr std::array<Keys, 2> kKeys{{{"body0_id", "body0_offset", "body0_orientation"},
                                         {"body1_id", "body1_offset", "body1_orientation"}}};
    for (std::size_t s = 0; s < 2; ++s) {
      int of = 0;
      const bool is_given = in.integer(kKeys[s].id, 0, 1'000'000'000, of, kRequired);
      const auto found = bodies_.find(of);
      if (is_given && found == bodies_.end()) in.problem(kKeys[s].id, "no body has this id");
      has_bodies = has_bodies && is_given && found != bodies_.end();
      if (has_bodies) sides[s].body = found->second;
      vector(in, kKeys[s].offset, kPositionRange, sides[s].anchor, kOptional);
      sides[s].axis = orientation(in, kKeys[s].orientation) * Vec3::UnitX();
    }
    list_others(in);
    if (!kind || !has_bodies) return;
    // The first body of a joint of a scene moves.
    if (builder_.body(sides[0].body).is_static) std::swap(sides[0], sides[1]);
    const auto [a, b] = sides;
    int i = 0;
    if (*kind == 1) {
      i = builder_.add_ball_joint(a.body, b.body, Vec3::Zero());
    } else {
      i = builder_.add_hinge(a.body, b.body, Vec3::Zero(), Vec3::UnitX());
      auto& hinge = std::get<HingeJoint>(builder_.scene().joints[index(i)]);
      hinge.axis_a = a.axis;
      hinge.axis_b = b.axis;
      // The frames may point against each other.
      const Vec3 in_world = builder_.body(a.body).orientation * a.axis;
      if (in_world.dot(builder_.body(b.body).orientation * b.axis) < 0.0) hinge.axis_b = -b.axis;
    }
    builder_.joint(i).name = joint_names_.unique("joint_" + std::to_string(id));
    builder_.joint(i).anchor_a = a.anchor;
    builder_.joint(i).anchor_b = b.anchor;
    places_.joints.push_back(pointer);
  }

  void read_physics(ObjectReader& in) {
    const Json* member = in.member("physics", kOptional);
    if (member == nullptr) return;
    ObjectReader physics = in.inner("physics", *member);
    vector(physics, "gravity", kGravityRange, builder_.scene().gravity, kOptional);
    for (const char* key : {"time_step", "solver_iterations"}) {
      if (physics.member(key, kOptional) != nullptr) {
        report_.left_out.add("/physics", "time step and solver: the scene has its own");
      }
    }
    list_others(physics);
  }

  const Json& json_;
  const ImportOptions& options_;
  ImportReport& report_;
  ScenePlaces& places_;
  Problems problems_;
  SceneBuilder builder_;
  UniqueNames names_{"world"};
  UniqueNames joint_names_;
  std::map<int, int> bodies_;  // indices by id
};

}  // namespace

bool is_slrbs(const Json& json) {
  if (!json.is_object() || json.contains("format")) return false;
  const auto bodies = json.find("bodies");
  return bodies != json.end() && bodies->is_array() && !bodies->empty() &&
         bodies->front().is_object() && bodies->front().contains("geometry");
}

std::optional<Scene> read_slrbs(const Json& json, const ImportOptions& options,
                                ImportReport& report, ScenePlaces& places) {
  return SlrbsReader(json, options, report, places).read();
}

}  // namespace substep
