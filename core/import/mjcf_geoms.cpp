#include "core/import/mjcf_geoms.hpp"

#include <algorithm>

#include "core/import/mesh.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr Range kDensityRange = not_negative(1e12, "kg/m^3");
constexpr Range kGeomMassRange = not_negative(1e12, "kg");
constexpr Range kGeomSizeRange = not_negative(1e6, "m");

/// How many sizes a kind has, and after `fromto`.
struct KindOfGeom {
  std::string_view name;
  Solid::Kind solid;
  std::size_t sizes;
  std::size_t sizes_after_fromto;  // 0: it has no fromto
};
constexpr KindOfGeom kSolids[] = {
    {"sphere", Solid::Kind::kSphere, 1, 0},     {"capsule", Solid::Kind::kCapsule, 2, 1},
    {"cylinder", Solid::Kind::kCylinder, 2, 1}, {"ellipsoid", Solid::Kind::kEllipsoid, 3, 1},
    {"box", Solid::Kind::kBox, 3, 1},
};

/// Half extents of a solid of these sizes, and its pose. @return false after an error
bool read_size(const KindOfGeom& kind, MjcfAttributes& in, MjcfGeom& geom) {
  const std::vector<double> ends = in.numbers("fromto", 6, 6, kPositionRange);
  const bool has_ends = !ends.empty() && kind.sizes_after_fromto > 0;
  const std::size_t needed = has_ends ? kind.sizes_after_fromto : kind.sizes;
  std::vector<double> size = in.numbers("size", 1, 3, kGeomSizeRange);
  if (size.size() < needed ||
      std::any_of(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(needed),
                  [](double s) { return !(s > 0.0); })) {
    in.error("a " + std::string(kind.name) + " needs " + std::to_string(needed) +
             (needed == 1 ? " size" : " sizes") + " above 0 (m)");
    return false;
  }
  size.resize(3, size.front());
  if (has_ends) {
    const Vec3 from(ends.data());
    const Vec3 to(ends.data() + 3);
    if (!((to - from).norm() > 1e-10)) {
      in.error("fromto has two ends in one place");
      return false;
    }
    geom.pose.position = 0.5 * (from + to);
    geom.pose.orientation = from_z_to(from - to);
    size = {size[0], size[0], 0.5 * (to - from).norm()};
  } else if (kind.sizes == 2) {
    size = {size[0], size[0], size[1]};
  }
  geom.solid = {kind.solid, Vec3(size.data())};
  geom.kind = MjcfGeom::Kind::kSolid;
  return true;
}

}  // namespace

MjcfMeshes read_meshes(const MjcfContext& context, const ModelFiles& read) {
  MjcfMeshes meshes;
  for (const XmlElement& section : context.document.root.children) {
    if (section.name != "asset") continue;
    for (const XmlElement& element : section.children) {
      if (element.name == "model") {
        context.report.left_out.add(context.document.place(element), "<model> of another file");
      }
      if (element.name == "texture" || element.name == "material" || element.name == "skin") {
        context.report.left_out.add(context.document.place(element),
                                    "colours, materials and user data");
      }
      if (element.name != "mesh") continue;
      MjcfAttributes in(context, element);
      in.ignore({"normal", "texcoord", "smoothnormal", "maxhullvert", "content_type"});
      const std::string file = in.text_or("file", "");
      const std::string stem = file.substr(file.find_last_of('/') + 1);
      const std::string name = in.text_or("name", stem.substr(0, stem.find_last_of('.')));
      const Vec3 scale = in.vector("scale", Vec3::Ones(), symmetric(1e6, "-"));
      const Vec3 origin = in.vector("refpos", Vec3::Zero(), kPositionRange);
      const std::vector<double> turn = in.numbers("refquat", 4, 4, symmetric(1e6, "-"));
      const std::string inertia = in.text_or("inertia", "");
      MjcfMesh& mesh = meshes[name];
      std::vector<Vec3> points;
      if (const std::string* given = in.text("vertex")) {
        points = points_of_text(*given, mesh.fault);
      } else if (const auto content = read ? read(context.compiler.mesh_folder + file)
                                           : std::optional<std::string>()) {
        points = points_of_file(file, *content, mesh.fault);
      } else {
        mesh.fault = "there is no file '" + file + "'";
      }
      if (!mesh.fault.empty()) continue;
      Quat back = Quat::Identity();
      if (!turn.empty()) back = Quat(turn[0], turn[1], turn[2], turn[3]).normalized().conjugate();
      for (Vec3& point : points) point = back * (scale.cwiseProduct(point) - origin);
      mesh.hull = hull_properties(points);
      if (!mesh.hull) mesh.fault = "the mesh is flat or too large";
      const bool is_hull = in.text("vertex") != nullptr && in.text("face") == nullptr;
      if (inertia == "shell" || (inertia != "convex" && !is_hull)) {
        context.report.approximated.add(in.place(), "a mesh has the inertia of its convex hull");
      }
    }
  }
  return meshes;
}

MjcfGeom read_geom(const MjcfContext& context, const MjcfMeshes& meshes, const XmlElement& element,
                   const DefaultClass* childclass, const Pose& frame) {
  MjcfGeom geom;
  MjcfAttributes in(context, element, childclass);
  in.ignore({"fromto", "size", "pos", "condim", "priority", "hfield", "fitscale"});
  const std::string type = in.text_or("type", "sphere");
  geom.group = in.number("group", 0.0, symmetric(1e6, "-"));
  geom.collides = in.number("contype", 1.0, symmetric(1e12, "-")) != 0.0 ||
                  in.number("conaffinity", 1.0, symmetric(1e12, "-")) != 0.0;
  const std::vector<double> friction = in.numbers("friction", 1, 3, kFrictionRange);
  if (!friction.empty()) geom.friction = friction.front();
  geom.pose = in.pose();
  const std::vector<double> mass = in.numbers("mass", 1, 1, kGeomMassRange);
  const double density = in.number("density", 1000.0, kDensityRange);
  const std::string* mesh_name = in.text("mesh");
  if (in.flag("shellinertia", false)) {
    context.report.approximated.add(in.place(), "a shell has the inertia of a solid");
  }

  const auto solid = std::find_if(std::begin(kSolids), std::end(kSolids),
                                  [&](const KindOfGeom& kind) { return kind.name == type; });
  if (type == "mesh") {
    const auto found = mesh_name == nullptr ? meshes.end() : meshes.find(*mesh_name);
    const bool has_mass = mass.empty() ? density > 0.0 : mass.front() > 0.0;
    if (found == meshes.end()) {
      in.error(mesh_name == nullptr ? "it names no mesh"
                                    : "no mesh is called '" + *mesh_name + "'");
    } else if (!found->second.hull) {
      if (has_mass) geom.without_mass = found->second.fault;
    } else {
      const MassProperties& hull = *found->second.hull;
      geom.mass = hull.scaled(mass.empty() ? density : mass.front() / hull.mass).moved(geom.pose);
    }
  } else if (type == "plane") {
    geom.kind = MjcfGeom::Kind::kPlane;
  } else if (type == "hfield" || type == "sdf") {
    geom.without_mass = "its geom of type " + type + " is not read";
  } else if (solid == std::end(kSolids)) {
    in.error("type " +
             must_be("plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh or sdf",
                     "'" + type + "'"));
  } else if (mesh_name != nullptr) {
    geom.without_mass = "a " + type + " fitted to a mesh is not read";
  } else if (read_size(*solid, in, geom)) {
    const double kilograms = mass.empty() ? density * volume(geom.solid) : mass.front();
    geom.mass = mass_properties(geom.solid, kilograms).moved(geom.pose);
  }
  geom.pose = frame * geom.pose;
  geom.mass = geom.mass.moved(frame);
  return geom;
}

}  // namespace substep
