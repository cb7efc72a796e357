#pragma once
// What the parts of the MJCF reader build together.

#include <map>
#include <string>
#include <vector>

#include "core/import/mechanism.hpp"
#include "core/import/mjcf_attributes.hpp"
#include "core/import/mjcf_geoms.hpp"

namespace substep {

/// A joint of a link.
struct JointIndex {
  std::size_t link = 0;
  std::size_t joint = 0;
};

struct MjcfModel {
  Mechanism mechanism;
  std::map<std::string, int> bodies;         // links by name; "world" is -1
  std::map<std::string, JointIndex> joints;  // by name
  struct Site {
    int link = -1;
    Pose pose;  // in the frame of the link
  };
  std::map<std::string, Site> sites;
  std::vector<double> controls;  // of the actuators, from a keyframe; may be empty

  LinkJoint& joint(const JointIndex& at) { return mechanism.links[at.link].joints[at.joint]; }
};

/// <flag> of <option>: what the model has switched off.
struct MjcfFlags {
  bool gravity = true;
  bool limits = true;
  bool friction = true;
  bool springs = true;
  bool dampers = true;
  bool equality = true;
  bool actuation = true;
};

/// Bodies with their joints, shapes and masses.
void read_bodies(const MjcfContext& context, const MjcfFlags& flags, const MjcfMeshes& meshes,
                 MjcfModel& model);

/// <equality>
void read_equality(const MjcfContext& context, MjcfModel& model);

/// <actuator>
void read_actuators(const MjcfContext& context, MjcfModel& model);

/// <keyframe>: sets start and rates of the joints, and the controls. @param key name or number; "":
/// none
void read_keyframe(const MjcfContext& context, const std::string& key, MjcfModel& model);

}  // namespace substep
