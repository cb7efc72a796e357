#include "core/model/scene_checks.hpp"
#include "core/model/format_text.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/math/angle.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

constexpr double kMaxAxisAngleSine = 0.1;  // between directions kept parallel, at the start [-]

/// The pose of one side of a joint.
struct Pose {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
};

Pose pose(const Scene& scene, int body) {
  if (body == kWorld) return {};
  const Body& b = scene.bodies[index(body)];
  return {b.position, b.orientation};
}

bool is_sound(const Scene& scene, const SoundParts& sound, std::size_t joint) {
  if (!sound.joints[joint]) return false;
  const JointBase& j = base(scene.joints[joint]);
  return sound.bodies[index(j.a)] && (j.b == kWorld || sound.bodies[index(j.b)]);
}

/// The two bodies of a joint, lower first; all that does not move is kWorld.
std::pair<int, int> sides(const Scene& scene, const JointBase& joint) {
  return std::minmax({joint.a, is_fixed(scene, joint.b) ? kWorld : joint.b});
}

/// The fault of two directions that a joint keeps parallel; nothing if they nearly are.
std::optional<std::string> parallel_fault(const Vec3& u, const Vec3& v) {
  const double sine = u.cross(v).norm();
  if (u.dot(v) < 0.0) return "start in opposite directions";
  if (sine <= kMaxAxisAngleSine) return std::nullopt;
  return "start at an angle with sine " + number_text(sine) + ", which is more than " +
         number_text(kMaxAxisAngleSine);
}

/// The fault of two directions that a joint keeps perpendicular; nothing if they nearly are.
std::optional<std::string> crossing_fault(const Vec3& u, const Vec3& v) {
  const double cosine = std::abs(u.dot(v));
  if (cosine <= kMaxAxisAngleSine) return std::nullopt;
  return "start at an angle with cosine " + number_text(cosine) + ", which is more than " +
         number_text(kMaxAxisAngleSine);
}

/// @param apart from the anchor on b to that on a, world [m]
/// @param gap by which a slide may start beyond its bounds [m]
void check_limit_start(const Joint& joint, const Quat& q_a, const Quat& q_b, const Vec3& apart,
                       double gap, std::size_t i, Problems& problems) {
  const Limit* limit = limit_of(joint);
  if (limit == nullptr || rope_length_of(joint)) return;
  const double middle = 0.5 * (limit->lower + limit->upper);
  const AngleLimit* of_angle = angle_limit_of(joint);
  double from_middle = (q_b * axes_of(joint)->b).dot(apart) - middle;
  if (of_angle != nullptr) {
    const Vec3 axis = q_a * axes_of(joint)->a;
    from_middle =
        wrapped(angle_about(axis, q_b * of_angle->across_b, q_a * of_angle->across_a) - middle);
  }
  const double beyond = of_angle != nullptr ? 0.1 : gap;
  if (std::abs(from_middle) <= 0.5 * (limit->upper - limit->lower) + beyond) return;
  problems.push_back({pointer_to(pointer_to("/joints", i), "limit"),
                      (of_angle != nullptr ? "the angle starts at " : "the travel starts at ") +
                          number_text(middle + from_middle) +
                          (of_angle != nullptr ? " (rad)" : " (m)") + ", outside " +
                          number_text(limit->lower) + " to " + number_text(limit->upper)});
}

/// 0 for a body that does not move [1/kg].
double inverse_mass(const Scene& scene, int body) {
  return is_fixed(scene, body) ? 0.0 : 1.0 / scene.bodies[index(body)].mass;
}

}  // namespace

void check_joint_starts(const Scene& scene, const SoundParts& sound, Problems& problems) {
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    if (!is_sound(scene, sound, i)) continue;
    const JointBase& j = base(scene.joints[i]);
    const Pose a = pose(scene, j.a);
    const Pose b = pose(scene, j.b);
    const Vec3 apart = a.x + a.q * j.anchor_a - b.x - b.q * j.anchor_b;
    const double gap = gap_of(scene.joints[i], apart, b.q).norm();
    const std::optional<double> length = length_of(scene.joints[i]);
    // Slower than a frame: it may start stretched. A stiffer one is a rod.
    const bool is_spring =
        length && j.compliance > 0.0 &&
        j.compliance >=
            scene.frame * scene.frame * (inverse_mass(scene, j.a) + inverse_mass(scene, j.b));
    if (!is_spring && gap > largest_gap(scene, j)) {
      const char* where = rope_length_of(scene.joints[i]) ? "beyond the length of their rope"
                          : length                        ? "away from their distance"
                                                          : "apart";
      problems.push_back({pointer_to("/joints", i),
                          format_text("the anchors start %.6g %s, which is more than %.6g (m)", gap,
                                      where, largest_gap(scene, j))});
    }
    const auto check_parallel = [&](const std::optional<JointAxes>& pair, const char* what) {
      if (!pair) return;
      const auto fault = parallel_fault(a.q * pair->a, b.q * pair->b);
      if (fault) problems.push_back({pointer_to("/joints", i), what + *fault});
    };
    // A run may be beyond a bound whose effect was off.
    if (!scene.carried) {
      check_limit_start(scene.joints[i], a.q, b.q, apart, largest_gap(scene, j), i, problems);
    }
    check_parallel(axes_of(scene.joints[i]), "the axes ");
    if (const auto pair = crossing_axes_of(scene.joints[i])) {
      const auto fault = crossing_fault(a.q * pair->a, b.q * pair->b);
      if (fault) problems.push_back({pointer_to("/joints", i), "the axes " + *fault});
    }
    check_parallel(across_of(scene.joints[i]), "the directions across the axes ");
  }
}

void check_redundant_rows(const Scene& scene, const SoundParts& sound, Problems& problems) {
  if (scene.regularisation > 0.0) return;                    // acts like compliance
  using First = std::map<std::pair<int, int>, std::size_t>;  // the first stiff joint of two bodies
  First stiff;
  First stiff_turning;
  const auto note = [&](First& first, std::size_t joint, const char* key, const char* unit) {
    const JointBase& j = base(scene.joints[joint]);
    const auto [other, is_new] = first.emplace(sides(scene, j), joint);
    if (is_new) return;
    const std::string& name = base(scene.joints[other->second]).name;
    problems.push_back({pointer_to(pointer_to("/joints", joint), key),
                        "0 here and in \"" + name + "\" between the same bodies: \"" + name +
                            "\" and \"" + j.name +
                            "\" are redundant, so one of them must be above 0 (" + unit + ")"});
  };
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    if (!is_sound(scene, sound, i)) continue;
    // Up to six rods may hold a body.
    if (length_of(scene.joints[i]) || rope_length_of(scene.joints[i])) continue;
    if (base(scene.joints[i]).compliance == 0.0) note(stiff, i, "compliance", "m/N");
    if (angular_compliance_of(scene.joints[i]) == 0.0) {
      note(stiff_turning, i, "angular_compliance", "rad/(N m)");
    }
  }
  const auto check_contacts = [&](bool has_rows, double compliance, const char* pointer) {
    if (!has_rows || compliance != 0.0) return;
    problems.push_back(
        {pointer,
         "must be above 0 (m/N), not 0: a box that lies on its face has redundant contacts"});
  };
  check_contacts(scene.effects.contact, scene.contact.compliance, "/contact/compliance");
  check_contacts(scene.effects.friction, scene.contact.friction_compliance,
                 "/contact/friction_compliance");
}

void check_effects(const Scene& scene, Problems& problems) {
  const Effects& listed = scene.effects;
  const auto missing = [&](const std::string& effect, const std::string& why) {
    problems.push_back({"/effects", '"' + effect + "\" is missing, but " + why});
  };
  if (!listed.joints && !scene.joints.empty()) {
    missing("joints", "/joints has " + std::to_string(scene.joints.size()));
  }
  for (const auto& [effect, name] :
       {std::pair(&Effects::limits, "limits"), std::pair(&Effects::motors, "motors"),
        std::pair(&Effects::drives, "drives"),
        std::pair(&Effects::joint_friction, "joint_friction"),
        std::pair(&Effects::armature, "armature"), std::pair(&Effects::springs, "springs")}) {
    if (!listed.joints && listed.*effect) {
      missing("joints", '"' + std::string(name) + "\" needs it");
    }
  }
  // Each is reported once.
  bool limits = listed.limits;
  bool motors = listed.motors;
  bool drives = listed.drives;
  bool joint_friction = listed.joint_friction;
  bool armature = listed.armature;
  bool springs = listed.springs;
  bool restitution = listed.restitution;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const auto given = [&](const char* part) {
      return pointer_to(pointer_to("/joints", i), part) + " is given";
    };
    const Limit* limit = limit_of(scene.joints[i]);
    const bool is_rope = rope_length_of(scene.joints[i]).has_value();
    if (limit != nullptr && !std::exchange(limits, true)) {
      missing("limits", is_rope ? pointer_to("/joints", i) + " is a rope" : given("limit"));
    }
    if (limit != nullptr && limit->restitution > 0.0 && !std::exchange(restitution, true)) {
      missing("restitution",
              is_rope ? "a rope has a restitution above 0" : "a limit has a restitution above 0");
    }
    if (motor_of(scene.joints[i]) != nullptr && !std::exchange(motors, true)) {
      missing("motors", given("motor"));
    }
    if (drive_of(scene.joints[i]) != nullptr && !std::exchange(drives, true)) {
      missing("drives", given("drive"));
    }
    if (spring_of(scene.joints[i]) != nullptr && !std::exchange(springs, true)) {
      missing("springs", given("spring"));
    }
    if (friction_of(scene.joints[i]) && !std::exchange(joint_friction, true)) {
      missing("joint_friction", given("friction"));
    }
    if (armature_of(scene.joints[i]) > 0.0 && !std::exchange(armature, true)) {
      missing("armature", given("armature"));
    }
  }
  for (std::size_t i = 0; i < scene.bodies.size() && !listed.external; ++i) {
    const Body& body = scene.bodies[i];
    if (body.force == Vec3::Zero() && body.torque == Vec3::Zero()) continue;
    const char* key = body.force != Vec3::Zero() ? "force" : "torque";
    missing("external", pointer_to(pointer_to("/bodies", i), key) + " is given");
    break;
  }
  // Optional rows of contacts, and the body data that needs them.
  const auto needs_contact = [&](bool Effects::*effect, const char* name, double Body::*coefficient,
                                 bool of_static) {
    if (!listed.contact && listed.*effect && !(listed.limits && effect == &Effects::restitution)) {
      missing("contact", "\"" + std::string(name) + "\" needs it");
    }
    if (!listed.contact || listed.*effect) return;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body& body = scene.bodies[i];
      if ((body.is_static && !of_static) || !body.collides || body.*coefficient == 0.0) continue;
      missing(name,
              pointer_to(pointer_to("/bodies", i), name) + " is " + number_text(body.*coefficient));
      return;
    }
  };
  // Friction needs a coefficient on both bodies. For restitution one is enough, even if it is
  // static.
  needs_contact(&Effects::friction, "friction", &Body::friction, false);
  needs_contact(&Effects::restitution, "restitution", &Body::restitution, true);
}

}  // namespace substep
