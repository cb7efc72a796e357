#include "core/import/mjcf.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/import/mjcf_model.hpp"
#include "core/model/number_text.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

/// Sections that are read, and those without effect on the motion.
constexpr std::string_view kRead[] = {"compiler",  "option",   "default",  "asset",
                                      "worldbody", "equality", "actuator", "keyframe"};
constexpr std::string_view kWithoutEffect[] = {"visual", "statistic", "size", "sensor", "custom"};

MjcfCompiler read_compiler(const MjcfContext& context) {
  MjcfCompiler compiler;
  for (const XmlElement& element : context.document.root.children) {
    if (element.name != "compiler") continue;
    MjcfAttributes in(context, element);
    in.ignore({"texturedir", "assetdir", "discardvisual", "fusestatic", "usethread", "strippath",
               "alignfree", "inertiagrouprange"});
    compiler.degrees = in.text_or("angle", compiler.degrees ? "degree" : "radian") != "radian";
    compiler.autolimits = in.flag("autolimits", compiler.autolimits);
    const std::string sequence = in.text_or("eulerseq", compiler.euler_sequence);
    if (sequence.size() == 3 && sequence.find_first_not_of("xyzXYZ") == std::string::npos) {
      compiler.euler_sequence = sequence;
    } else {
      in.error("eulerseq " + must_be("three letters of xyzXYZ", "'" + sequence + "'"));
    }
    if (in.text_or("coordinate", "local") != "local") in.error("coordinate must be local");
    if (const auto from = in.choice("inertiafromgeom")) {
      compiler.inertia_from_geom =
          *from ? MjcfCompiler::FromGeom::kYes : MjcfCompiler::FromGeom::kNo;
    }
    const std::vector<double> groups = in.numbers("inertiagrouprange", 2, 2, symmetric(1e6, "-"));
    if (!groups.empty()) {
      compiler.group_least = groups[0];
      compiler.group_most = groups[1];
    }
    compiler.least_mass = in.number("boundmass", compiler.least_mass, not_negative(1e12, "kg"));
    compiler.least_inertia =
        in.number("boundinertia", compiler.least_inertia, not_negative(1e12, "kg m^2"));
    compiler.balance_inertia = in.flag("balanceinertia", compiler.balance_inertia);
    compiler.total_mass = in.number("settotalmass", compiler.total_mass, symmetric(1e12, "kg"));
    std::string folder = in.text_or("assetdir", "");
    folder = in.text_or("meshdir", folder);
    if (!folder.empty()) compiler.mesh_folder = folder + "/";
  }
  return compiler;
}

void read_flags(const MjcfContext& context, const XmlElement& option, MjcfFlags& flags) {
  for (const XmlElement& element : option.children) {
    if (element.name != "flag") {
      context.report.left_out.add(context.document.place(element), "<" + element.name + ">");
      continue;
    }
    MjcfAttributes in(context, element);
    in.ignore({"contact", "clampctrl", "warmstart", "filterparent", "sensor", "midphase",
               "nativeccd", "eulerdamp", "autoreset", "island", "multiccd", "energy", "fwdinv",
               "refsafe", "override", "invdiscrete"});
    flags.gravity = in.flag("gravity", flags.gravity);
    flags.limits = in.flag("limit", flags.limits);
    flags.friction = in.flag("frictionloss", flags.friction);
    flags.equality = in.flag("equality", flags.equality);
    flags.actuation = in.flag("actuation", flags.actuation);
    flags.springs = in.flag("spring", in.flag("passive", flags.springs));
    flags.dampers = in.flag("damper", in.flag("passive", flags.dampers));
    if (!in.flag("constraint", true)) flags.limits = flags.friction = flags.equality = false;
  }
}

MjcfFlags read_options(const MjcfContext& context, Mechanism& mechanism) {
  MjcfFlags flags;
  context.report.timestep = 0.002;  // MuJoCo's default
  context.report.integrator = "Euler";
  for (const XmlElement& element : context.document.root.children) {
    if (element.name != "option") continue;
    MjcfAttributes in(context, element);
    in.ignore({"integrator", "solver", "iterations", "tolerance", "ls_iterations", "ls_tolerance",
               "noslip_iterations", "noslip_tolerance", "ccd_iterations", "ccd_tolerance",
               "jacobian", "cone", "impratio", "timestep", "apirate", "sdf_iterations",
               "sdf_initpoints"});
    mechanism.gravity = in.vector("gravity", mechanism.gravity, kGravityRange);
    const std::string* timestep = in.text("timestep");
    const std::string* integrator = in.text("integrator");
    if (timestep != nullptr) {
      context.report.timestep = parse_number(*timestep).value_or(context.report.timestep);
    }
    if (integrator != nullptr) context.report.integrator = *integrator;
    if (timestep != nullptr || integrator != nullptr) {
      context.report.left_out.add(in.place(),
                                  "time step, integrator and solver: the scene has its own");
    }
    read_flags(context, element, flags);
  }
  if (!flags.gravity) mechanism.gravity.setZero();
  return flags;
}

void list_sections(const MjcfContext& context) {
  const auto is_in = [](const auto& list, const std::string& name) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
  };
  for (const XmlElement& section : context.document.root.children) {
    const std::string place = context.document.place(section);
    if (is_in(kRead, section.name)) continue;
    if (is_in(kWithoutEffect, section.name)) {
      context.report.left_out.add(place,
                                  "sections without effect on the motion: visual, sensor and "
                                  "the like");
    } else if (section.name == "contact") {
      for (const XmlElement& element : section.children) {
        context.report.left_out.add(
            context.document.place(element),
            "<contact> '" + element.name + "': bodies of one tree never collide here");
      }
    } else if (section.name == "tendon") {
      for (const XmlElement& element : section.children) {
        context.report.left_out.add(context.document.place(element),
                                    "a tendon (" + element.name + ")");
      }
    } else {
      context.report.left_out.add(place, "<" + section.name + "> and all that is in it");
    }
  }
}

}  // namespace

std::optional<Mechanism> read_mjcf(XmlElement root, const std::string& file,
                                   const ModelFiles& files, const ImportOptions& options,
                                   ImportReport& report) {
  const auto document = include_files(std::move(root), file, files, report.errors);
  if (!document) return std::nullopt;
  const DefaultClasses defaults(*document, report.errors);
  MjcfCompiler compiler;
  const MjcfContext context{*document, defaults, compiler, report};
  compiler = read_compiler(context);
  MjcfModel model;
  Mechanism& mechanism = model.mechanism;
  mechanism.source = "MJCF";
  const std::string* name = document->root.attribute("model");
  const std::string stem = file.substr(0, file.find_last_of('.'));
  mechanism.name = name == nullptr || name->empty() ? stem : *name;
  const MjcfFlags flags = read_options(context, mechanism);
  const MjcfMeshes meshes = read_meshes(context, files);
  read_bodies(context, flags, meshes, model);
  if (flags.equality) read_equality(context, model);
  read_keyframe(context, options.key, model);
  if (flags.actuation) read_actuators(context, model);
  list_sections(context);
  if (!report.errors.empty()) return std::nullopt;
  return std::move(mechanism);
}

}  // namespace substep
