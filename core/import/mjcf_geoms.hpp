#pragma once
// Shapes of MJCF: <geom> and the meshes that it names.

#include <map>
#include <optional>
#include <string>

#include "core/import/mechanism.hpp"
#include "core/import/mjcf_attributes.hpp"
#include "core/import/model_files.hpp"

namespace substep {

/// A mesh of <asset>: the mass properties of its convex hull at a density of 1 kg/m^3, or the
/// reason why there are none.
struct MjcfMesh {
  std::optional<MassProperties> hull;
  std::string fault;  // "there is no file 'foot.stl'"
};
using MjcfMeshes = std::map<std::string, MjcfMesh>;

/// @param read may be empty
MjcfMeshes read_meshes(const MjcfContext& context, const ModelFiles& read);

/// One <geom>.
struct MjcfGeom {
  enum class Kind { kSolid, kPlane, kOther };
  Kind kind = Kind::kOther;
  Solid solid;
  Pose pose;            // in the frame of its body
  MassProperties mass;  // in the frame of its body
  bool collides = true;
  double friction = 1.0;  // of sliding [-]
  double group = 0.0;
  std::string without_mass;  // why it has no mass although it should, or ""
};

/// @param frame of the <frame>s around it
MjcfGeom read_geom(const MjcfContext& context, const MjcfMeshes& meshes, const XmlElement& element,
                   const DefaultClass* childclass, const Pose& frame);

}  // namespace substep
