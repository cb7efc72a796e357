#pragma once
// What MJCF and URDF describe, in one form: a tree of links with joints, loops between them, and
// what of their shapes a scene can hold. assemble() makes a scene of it.

#include <optional>
#include <string>
#include <vector>

#include "core/import/import_options.hpp"
#include "core/import/import_report.hpp"
#include "core/import/mass_properties.hpp"
#include "core/import/solid.hpp"
#include "core/model/joint.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A joint between a link and its parent. Its coordinate is an angle or a travel; hinges and slides
/// have one.
struct LinkJoint {
  enum class Kind { kHinge, kSlide, kBall, kFree };
  Kind kind = Kind::kHinge;
  std::string name;
  std::string place;           // in the model, for messages
  Vec3 anchor = Vec3::Zero();  // in the link's frame [m]
  Vec3 axis = Vec3::UnitZ();   // in the link's frame, unit [-]
  double reference = 0.0;      // coordinate in the pose of the model [rad or m]
  double start = 0.0;          // coordinate at the start [rad or m]
  double rate = 0.0;           // of the coordinate at the start [rad/s or m/s]
  std::optional<Limit> limit;  // of the coordinate
  double stiffness = 0.0;      // of a spring towards `rest` [N m/rad or N/m]
  double rest = 0.0;           // [rad or m]
  double damping = 0.0;        // [N m s/rad or N s/m]
  double friction = 0.0;       // dry [N m or N]
  double armature = 0.0;       // inertia of its rotor [kg m^2 or kg]
  std::optional<Drive> drive;  // of an actuator, besides spring and damper
};

struct LinkShape {
  Solid solid;
  Pose pose;  // in the link's frame
};

struct Link {
  std::string name;
  std::string place;
  int parent = -1;                // an earlier link, or -1: the world
  Pose pose;                      // in the frame of the parent, with all joints at their reference
  std::vector<LinkJoint> joints;  // one after the other; none: fixed to the parent
  MassProperties mass;            // in the frame of the link
  std::string without_mass;       // why it may lack mass: "its mesh 'foot' is not read"; or ""
  std::vector<LinkShape> shapes;  // that collide in the model
  bool has_other_shapes = false;  // that collide in the model, but are no solids of a scene
  double friction = 0.0;          // of its shapes [-]
  // Of a link with a free joint: pose and velocities at the start, in the world.
  std::optional<Pose> free_start;
  Vec3 free_velocity = Vec3::Zero();          // of the origin of the link [m/s]
  Vec3 free_angular_velocity = Vec3::Zero();  // in the axes of the link [rad/s]
  std::optional<Quat> ball_start;             // of a ball joint
};

/// A constraint between two links besides the tree.
struct LinkLoop {
  enum class Kind { kBall, kWeld };
  Kind kind = Kind::kBall;
  std::string name;
  std::string place;
  int a = -1;  // link, or -1: the world
  int b = -1;
  Pose on_a;  // the point, and for a weld the axes, in the frame of a
  Pose on_b;  // the same in that of b
};

/// A half-space of the world.
struct GroundPlane {
  std::string name;
  std::string place;
  Pose pose;  // its normal is z
  double friction = 0.0;
};

struct Mechanism {
  std::string name;
  std::string source;             // "MJCF" or "URDF"
  bool joins_massless = false;    // a link without mass and the only one beyond it are one
  Vec3 gravity{0.0, 0.0, -9.81};  // z up [m/s^2]
  std::vector<Link> links;        // parents first
  std::vector<LinkLoop> loops;
  std::vector<GroundPlane> grounds;
};

/// The pose of every link in the world, with all joints at their reference.
std::vector<Pose> reference_poses(const Mechanism& mechanism);

/// Where the bodies and joints of a scene are in the model.
struct ScenePlaces {
  std::vector<std::string> bodies;
  std::vector<std::string> joints;
};

/// A scene with Y up. Links without joints become part of their parents, bodies get their principal
/// axes, and several joints in one place become what they are together. The scene is not yet
/// validated; `report` has errors for what cannot be expressed.
Scene assemble(Mechanism mechanism, const ImportOptions& options, ImportReport& report,
               ScenePlaces& places);

}  // namespace substep
