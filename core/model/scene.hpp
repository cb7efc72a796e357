#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/body.hpp"
#include "core/model/carried.hpp"
#include "core/model/effects.hpp"
#include "core/model/expectation.hpp"
#include "core/model/joint.hpp"
#include "core/model/recommended.hpp"
#include "core/model/settings.hpp"
#include "core/model/start_policy.hpp"

namespace substep {

/// The contact law of a scene.
struct ContactModel {
  double compliance = 1e-10;           // C of the normal row [m/N]
  double friction_compliance = 1e-10;  // C of the friction rows [m/N]
  double margin = 0.02;                // rows are created for gaps up to this [m]
  double restitution_speed = 0.1;      // slower approaches do not bounce [m/s]
  double soft_compliance = 1e-6;       // contacts at least as compliant are springs [m/N]
};

/// True if contacts are springs; stiffer ones model rigid bodies, which land without rebound or
/// with that of their coefficient of restitution.
inline bool is_soft(const ContactModel& contact) {
  return contact.compliance >= contact.soft_compliance;
}

/// An energy gain that is not judged [J].
inline constexpr double kAnyEnergy = std::numeric_limits<double>::infinity();

/// Failure criteria of a run, and the scale of its errors. Limits that are not stated follow from
/// the sizes, masses and energies of the run: core/lab/verdict.hpp.
struct Criteria {
  double duration = 10.0;              // simulated by `check` [s]
  std::optional<double> joint_gap;     // a larger gap of any joint fails [m]
  std::optional<double> energy_gain;   // a larger gain over the start fails; or kAnyEnergy [J]
  std::optional<double> energy_scale;  // energy that the motion exchanges: 100 % of the drift [J]
  struct Displacement {
    int body = 0;           // index into Scene::bodies
    double distance = 0.1;  // [m]
  };
  std::optional<Displacement> displacement;  // this body moved farther than this fails
  std::optional<int> track;                  // the body whose path is compared
  std::optional<double> window;              // the path is compared for this long [s]
  bool holds = true;                         // the verdict expected with the scene's own settings
};

/// Initial camera of a view.
struct Camera {
  Vec3 eye{0.0, 5.0, 20.0};     // world [m]
  Vec3 target{0.0, 3.0, 0.0};   // world [m]
  std::optional<double> width;  // visible around the target [m]; if empty, every body is visible
};

/// Everything that does not change while a scene runs.
struct Scene {
  std::string name;         // identifier: file name without .json
  std::string title;        // for people
  std::string group;        // "paper", "exact", "energy", "stress", "playground"
  std::string description;  // what it is
  std::string look_for;     // what to watch

  double frame = 1.0 / 60.0;      // h, the displayed frame [s]
  Vec3 gravity{0.0, -9.81, 0.0};  // [m/s^2]
  Effects effects;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  ContactModel contact;
  double regularisation = 0.0;  // added to the diagonal of J M^-1 J^T, independent of dt [1/kg]
  StartPolicy start = StartPolicy::kProject;  // treatment of a start inconsistent with the joints
  Settings settings;                          // initial settings
  std::optional<Recommended> recommended;     // from a sweep over this scene
  Criteria criteria;
  Expectations verdicts;  // rules of the verdict table, or empty
  Camera camera;
  std::optional<Carried> carried;  // state of the run that this scene was saved from
};

/// True for the world and static bodies, which never move. @param body index, or kWorld
inline bool is_fixed(const Scene& scene, int body) {
  return body == kWorld || scene.bodies[index(body)].is_static;
}

/// The radius of a body's shape about its centre; 0 for kWorld and for an index that no body has.
inline double radius_of_body(const Scene& scene, int body) {
  if (body < 0 || index(body) >= scene.bodies.size()) return 0.0;
  return radius_around(scene.bodies[index(body)].shape);
}

/// Reference length for a joint's gap: both arms plus the radius of body a [m].
inline double size_of_joint(const Scene& scene, const JointBase& joint) {
  // A world anchor is a position, not an arm.
  const double arm_b = joint.b == kWorld ? 0.0 : joint.anchor_b.norm();
  return joint.anchor_a.norm() + arm_b + radius_of_body(scene, joint.a);
}

/// The gap at which a joint counts as torn, unless it is a spring, whose stretch is part of the
/// motion. At the start it is an error of the scene [m].
inline double largest_gap(const Scene& scene, const JointBase& joint) {
  constexpr double kTorn = 0.1;  // of its size
  // A joint at the centre of b has no arms, and a may be a plane.
  const bool has_b = joint.b >= 0 && index(joint.b) < scene.bodies.size();
  const double b = has_b && !is_fixed(scene, joint.b) ? radius_of_body(scene, joint.b) : 0.0;
  return scene.criteria.joint_gap.value_or(kTorn * std::max(size_of_joint(scene, joint), b));
}

/// The scene's own settings: the paper's if it starts with its recommendation. Sweeps start from
/// these, independent of earlier recommendations.
inline Settings own_settings(const Scene& scene) {
  if (!scene.recommended) return scene.settings;
  Settings recommended = scene.recommended->settings;
  recommended.watch_stiffness = scene.settings.watch_stiffness;  // display only
  return scene.settings == recommended ? kPaperSettings : scene.settings;
}

/// The scene with a recommendation. It replaces the initial settings, unless the scene has its own
/// (own_settings()) and they are neither the defaults nor the paper's.
inline Scene with_recommended(Scene scene, Recommended recommended) {
  const Settings own = own_settings(scene);
  if (own == Settings{} || own == kPaperSettings) {
    scene.settings = recommended.settings;
  }
  scene.recommended = std::move(recommended);
  return scene;
}

}  // namespace substep
