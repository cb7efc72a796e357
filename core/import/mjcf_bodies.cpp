#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/import/mjcf_geoms.hpp"
#include "core/import/mjcf_model.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr std::size_t kMostCopies = 10'000;
constexpr std::size_t kMostItems = 1'000'000;

/// An element of the tree that is still to be read.
struct Item {
  const XmlElement* element;
  int link;                        // that it belongs to, or -1: the world
  Pose frame;                      // in that link, of the <frame>s around it
  const DefaultClass* childclass;  // null: the main class
  std::string suffix;              // of names in a <replicate>
};

const char* const kSeen[] = {"light", "camera"};

class BodyReader {
 public:
  BodyReader(const MjcfContext& context, const MjcfFlags& flags, const MjcfMeshes& meshes,
             MjcfModel& model)
      : context_(context), flags_(flags), meshes_(meshes), model_(model) {}

  void read() {
    add_world();
    for (const XmlElement& section : context_.document.root.children) {
      if (section.name != "worldbody") continue;
      push_children({&section, -1, Pose(), nullptr, ""});
      while (!open_.empty()) {
        const Item item = std::move(open_.back());
        open_.pop_back();
        if (++items_ > kMostItems) {
          return context_.report.errors.add(place(section), "too many elements with their copies");
        }
        read(item);
      }
    }
    for (std::size_t i = 1; i < parts_.size(); ++i) set_mass(i);
    scale_masses();
  }

 private:
  /// Of a link, before its mass is known.
  struct Parts {
    std::optional<MassProperties> inertial;
    MassProperties of_geoms;
    std::string without_mass;
    const DefaultClass* childclass = nullptr;
  };

  std::vector<Link>& links() { return model_.mechanism.links; }
  [[nodiscard]] std::string place(const XmlElement& element) const {
    return context_.document.place(element);
  }

  /// The world as a link, for its shapes.
  void add_world() {
    Link world;
    world.name = "ground";
    world.place = context_.document.files.front();
    links().push_back(world);
    parts_.emplace_back();
    model_.bodies["world"] = -1;
  }

  void push_children(const Item& of) {
    const auto& children = of.element->children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      open_.push_back({&*child, of.link, of.frame, of.childclass, of.suffix});
    }
  }

  void read(const Item& item) {
    const std::string& tag = item.element->name;
    if (tag == "body") return read_body(item);
    if (tag == "geom") return read_geom_of(item);
    if (tag == "joint" || tag == "freejoint") return read_joint(item);
    if (tag == "inertial") return read_inertial(item);
    if (tag == "site") return read_site(item);
    if (tag == "frame") return read_frame(item);
    if (tag == "replicate") return read_replicate(item);
    if (std::find(std::begin(kSeen), std::end(kSeen), tag) != std::end(kSeen)) {
      return context_.report.left_out.add(place(*item.element), "lights and cameras");
    }
    context_.report.left_out.add(place(*item.element), "<" + tag + "> and all that is in it");
  }

  void read_frame(const Item& item) {
    MjcfAttributes in(context_, *item.element, item.childclass);
    in.ignore({"childclass"});
    Item inner = item;
    inner.frame = item.frame * in.pose();
    inner.childclass = class_named_by(context_, *item.element, "childclass", item.childclass);
    push_children(inner);
  }

  void read_replicate(const Item& item) {
    MjcfAttributes in(context_, *item.element, item.childclass);
    const double count = in.number("count", 0.0, {0.0, static_cast<double>(kMostCopies)});
    const Vec3 offset = in.vector("offset", Vec3::Zero(), kPositionRange);
    const std::string separator = in.text_or("sep", "");
    const std::vector<double> angles = in.numbers("euler", 3, 3, symmetric(1e6, "-"));
    const double unit = context_.compiler.degrees ? std::numbers::pi / 180.0 : 1.0;
    const Vec3 turn = angles.empty() ? Vec3(Vec3::Zero()) : Vec3(unit * Vec3(angles.data()));
    const auto copies = static_cast<std::size_t>(count);
    copies_ += copies * std::max<std::size_t>(item.element->children.size(), 1);
    if (copies_ > kMostCopies) return in.error("more than 10000 copies");
    const std::size_t digits = std::to_string(copies == 0 ? 0 : copies - 1).size();
    std::vector<Item> inner;
    // The angles of the copies are multiples, and each offset is in the frame of the last copy.
    Pose frame;
    for (std::size_t i = 0; i < copies; ++i) {
      std::string number = std::to_string(i);
      number.insert(0, digits - number.size(), '0');
      frame.orientation =
          euler_orientation(static_cast<double>(i) * turn, context_.compiler.euler_sequence);
      inner.push_back({item.element, item.link, item.frame * frame, item.childclass,
                       separator + number + item.suffix});
      frame.position += frame.orientation * offset;
    }
    for (auto copy = inner.rbegin(); copy != inner.rend(); ++copy) push_children(*copy);
  }

  void read_body(const Item& item) {
    MjcfAttributes in(context_, *item.element, item.childclass);
    in.ignore({"childclass", "sleep"});
    if (in.flag("mocap", false)) {
      context_.report.approximated.add(in.place(), "a mocap body does not move");
    }
    if (links().size() > kMaxBodies) return context_.report.errors.add("", "too many bodies");
    Link link;
    const std::string name = in.text_or("name", "");
    link.name = name.empty() ? "body" + std::to_string(links().size()) : name + item.suffix;
    link.place = in.place();
    link.parent = item.link;
    link.pose = item.frame * in.pose();
    const int index_of_link = static_cast<int>(links().size());
    if (!name.empty() && !model_.bodies.emplace(link.name, index_of_link).second) {
      in.error("another body has this name");
    }
    links().push_back(std::move(link));
    Parts parts;
    parts.childclass = class_named_by(context_, *item.element, "childclass", item.childclass);
    parts_.push_back(parts);
    push_children({item.element, index_of_link, Pose(), parts.childclass, item.suffix});
  }

  void read_inertial(const Item& item) {
    if (item.link < 0) return;
    MjcfAttributes in(context_, *item.element, item.childclass);
    const Pose pose = item.frame * in.pose();
    MassProperties mass;
    mass.mass = in.number("mass", 0.0, not_negative(kMassRange.most, "kg"));
    const Range range = symmetric(kInertiaRange.most, "kg m^2");
    const std::vector<double> full = in.numbers("fullinertia", 6, 6, range);
    const Vec3 diagonal = in.vector("diaginertia", Vec3::Zero(), range);
    mass.inertia = diagonal.asDiagonal();
    if (!full.empty()) {
      mass.inertia << full[0], full[3], full[4],  //
          full[3], full[1], full[5],              //
          full[4], full[5], full[2];
    }
    parts_[index(item.link)].inertial = mass.moved(pose);
  }

  void read_geom_of(const Item& item) {
    const MjcfGeom geom = read_geom(context_, meshes_, *item.element, item.childclass, item.frame);
    const std::size_t i = item.link < 0 ? 0 : index(item.link);
    Link& link = links()[i];
    Parts& parts = parts_[i];
    const MjcfCompiler& compiler = context_.compiler;
    if (geom.group >= compiler.group_least && geom.group <= compiler.group_most) {
      parts.of_geoms += geom.mass;
      if (parts.without_mass.empty()) parts.without_mass = geom.without_mass;
    }
    if (!geom.collides) return;
    const std::string where = place(*item.element);
    if (geom.kind == MjcfGeom::Kind::kPlane && item.link < 0) {
      model_.mechanism.grounds.push_back({"floor", where, geom.pose, geom.friction});
    } else if (geom.kind == MjcfGeom::Kind::kSolid &&
               (geom.solid.kind == Solid::Kind::kSphere || geom.solid.kind == Solid::Kind::kBox)) {
      link.shapes.push_back({geom.solid, geom.pose});
      link.friction = geom.friction;
    } else {
      link.has_other_shapes = true;
      if (item.link < 0) {
        context_.report.left_out.add(where, "a shape of the world that is no plane, sphere or box");
      }
    }
  }

  void read_site(const Item& item) {
    MjcfAttributes in(context_, *item.element, item.childclass);
    in.ignore({"type", "size", "group", "fromto"});
    const Pose pose = item.frame * in.pose();
    const std::string name = in.text_or("name", "");
    if (!name.empty()) model_.sites[name + item.suffix] = {item.link, pose};
  }

  void read_joint(const Item& item) {
    MjcfAttributes in(context_, *item.element, item.childclass);
    in.ignore({"group"});
    if (item.link < 0) return in.error("the world has no joints");
    Link& link = links()[index(item.link)];
    LinkJoint joint;
    joint.place = in.place();
    const std::string name = in.text_or("name", "");
    joint.name = (name.empty() ? link.name : name) + item.suffix;
    const std::string type =
        item.element->name == "freejoint" ? "free" : in.text_or("type", "hinge");
    using Kind = LinkJoint::Kind;
    constexpr std::pair<std::string_view, Kind> kKinds[] = {{"hinge", Kind::kHinge},
                                                            {"slide", Kind::kSlide},
                                                            {"ball", Kind::kBall},
                                                            {"free", Kind::kFree}};
    const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const auto& known) { return known.first == type; });
    if (kind == std::end(kKinds)) {
      return in.error("type " + must_be("free, ball, slide or hinge", "'" + type + "'"));
    }
    joint.kind = kind->second;
    joint.anchor = item.frame * in.vector("pos", Vec3::Zero(), kPositionRange);
    const Vec3 axis = in.vector("axis", Vec3::UnitZ(), kPositionRange);
    if (!(axis.norm() > 1e-10)) return in.error("axis has length 0");
    joint.axis = item.frame.orientation * axis.normalized();
    if (joint.kind == Kind::kFree) {
      in.ignore({"align", "pos", "axis", "limited", "range", "stiffness", "springref", "ref"});
    }
    read_coordinate(in, joint);
    if (!name.empty() &&
        !model_.joints.emplace(joint.name, JointIndex{index(item.link), link.joints.size()})
             .second) {
      in.error("another joint has this name");
    }
    link.joints.push_back(std::move(joint));
  }

  /// What acts on the coordinate of a joint.
  void read_coordinate(MjcfAttributes& in, LinkJoint& joint) {
    const bool turns = joint.kind != LinkJoint::Kind::kSlide;
    const double unit = turns && context_.compiler.degrees ? std::numbers::pi / 180.0 : 1.0;
    const Range angles = symmetric(1e6, turns ? "degrees or radians" : "m");
    joint.reference = unit * in.number("ref", 0.0, angles);
    joint.start = joint.reference;
    joint.rest = unit * in.number("springref", 0.0, angles);
    const double stiffness = in.number("stiffness", 0.0, not_negative(1e12, "N m/rad or N/m"));
    const double damping = in.number("damping", 0.0, not_negative(1e12, "N m s/rad or N s/m"));
    const double friction = in.number("frictionloss", 0.0, not_negative(1e12, "N m or N"));
    joint.armature = in.number("armature", 0.0, not_negative(1e12, "kg m^2 or kg"));
    if (flags_.springs) joint.stiffness = stiffness;
    if (flags_.dampers) joint.damping = damping;
    if (flags_.friction) joint.friction = friction;
    const std::vector<double> range = in.numbers("range", 2, 2, angles);
    const bool is_limited =
        in.choice("limited").value_or(context_.compiler.autolimits && !range.empty());
    if (is_limited && flags_.limits && joint.kind != LinkJoint::Kind::kFree) {
      if (range.empty() || (joint.kind != LinkJoint::Kind::kBall && !(range[0] < range[1]))) {
        in.error("a limited joint needs a range, from lower to upper");
      } else {
        joint.limit = Limit{unit * range[0], unit * range[1], 0.0};
      }
    }
  }

  /// Of a body, from <inertial> or its geoms.
  void set_mass(std::size_t i) {
    using FromGeom = MjcfCompiler::FromGeom;
    const Parts& parts = parts_[i];
    const MjcfCompiler& compiler = context_.compiler;
    Link& link = links()[i];
    const bool from_geoms = compiler.inertia_from_geom == FromGeom::kYes ||
                            (compiler.inertia_from_geom == FromGeom::kAuto && !parts.inertial);
    link.mass = from_geoms ? parts.of_geoms : parts.inertial.value_or(MassProperties());
    if (from_geoms && !parts.without_mass.empty()) {
      link.without_mass = parts.without_mass;
      if (link.mass.mass > 0.0) {
        context_.report.approximated.add(
            link.place, "a body without the mass of some of its shapes: " + parts.without_mass);
      }
    }
    link.mass.mass = std::max(link.mass.mass, compiler.least_mass);
    if (!(link.mass.mass > 0.0)) return;
    PrincipalAxes axes = principal_axes(link.mass.inertia);
    Vec3 moments = axes.moments.cwiseMax(compiler.least_inertia);
    if (compiler.balance_inertia && inertia_fault(moments)) {
      moments.setConstant(moments.mean());
    }
    if (!(moments.minCoeff() > 0.0) && !link.joints.empty()) {
      context_.report.errors.add(
          link.place, "body '" + link.name + "': its moments of inertia are not positive");
    }
    if (const auto fault = inertia_fault(moments)) {
      context_.report.errors.add(link.place, "body '" + link.name + "': " + *fault);
    }
    if (moments == axes.moments) return;
    const Mat3 R = axes.orientation.toRotationMatrix();
    link.mass.inertia = R * moments.asDiagonal() * R.transpose();
  }

  void scale_masses() {
    if (!(context_.compiler.total_mass > 0.0)) return;
    double sum = 0.0;
    for (const Link& link : links()) sum += link.mass.mass;
    if (!(sum > 0.0)) return;
    for (Link& link : links()) link.mass = link.mass.scaled(context_.compiler.total_mass / sum);
  }

  const MjcfContext& context_;
  const MjcfFlags& flags_;
  const MjcfMeshes& meshes_;
  MjcfModel& model_;
  std::vector<Item> open_;
  std::vector<Parts> parts_;  // of every link
  std::size_t copies_ = 0;
  std::size_t items_ = 0;
};

}  // namespace

void read_bodies(const MjcfContext& context, const MjcfFlags& flags, const MjcfMeshes& meshes,
                 MjcfModel& model) {
  BodyReader(context, flags, meshes, model).read();
}

}  // namespace substep
