#include "core/import/urdf.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/import/xml_numbers.hpp"
#include "core/model/body_checks.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

using Kind = LinkJoint::Kind;

struct UrdfJoint {
  const XmlElement* element;
  int parent;
  int child;
};

class UrdfReader {
 public:
  UrdfReader(const XmlElement& root, std::string file, const ImportOptions& options,
             ImportReport& report)
      : root_(root), file_(std::move(file)), options_(options), report_(report) {}

  Mechanism read() {
    mechanism_.source = "URDF";
    mechanism_.joins_massless = true;
    const std::string* name = root_.attribute("name");
    mechanism_.name = name == nullptr ? "robot" : *name;
    for (const XmlElement& element : root_.children) {
      if (element.name == "link") read_link(element);
    }
    for (const XmlElement& element : root_.children) {
      if (element.name == "joint") {
        find_links(element);
      } else if (element.name == "material") {
        report_.left_out.add(place(element), "colours and materials");
      } else if (element.name != "link") {
        report_.left_out.add(place(element), "<" + element.name + ">");
      }
    }
    if (links_.empty()) report_.errors.add(place(root_), "the robot has no links");
    if (report_.errors.empty()) sort_links();
    return std::move(mechanism_);
  }

 private:
  [[nodiscard]] std::string place(const XmlElement& element) const {
    return file_ + ":" + std::to_string(element.line);
  }
  void error(const XmlElement& element, const std::string& text) {
    report_.errors.add(place(element), text);
  }

  /// Exactly as many numbers as in `otherwise`, which is returned if the attribute is not there.
  std::vector<double> numbers(const XmlElement* element, const char* key,
                              std::vector<double> otherwise, const Range& range) {
    const std::string* text = element == nullptr ? nullptr : element->attribute(key);
    if (text == nullptr) return otherwise;
    const auto found = numbers_of(*text, otherwise.size());
    const auto is_outside = [&](double x) { return !range.contains(x); };
    if (!found || found->size() != otherwise.size()) {
      error(*element, "<" + element->name + ">: " + key + " " +
                          must_be(std::to_string(otherwise.size()) +
                                      (otherwise.size() == 1 ? " number" : " numbers"),
                                  "'" + text->substr(0, 60) + "'"));
      return otherwise;
    }
    const auto outside = std::find_if(found->begin(), found->end(), is_outside);
    if (outside == found->end()) return *found;
    error(*element, "<" + element->name + ">: " + key + " " +
                        must_be(range.violated_by(*outside), number_text(*outside)));
    return otherwise;
  }
  double number(const XmlElement* element, const char* key, double otherwise, const Range& range) {
    return numbers(element, key, {otherwise}, range).front();
  }
  Vec3 vector(const XmlElement* element, const char* key, const Vec3& otherwise) {
    const std::vector<double> found =
        numbers(element, key, {otherwise.x(), otherwise.y(), otherwise.z()}, kPositionRange);
    return Vec3(found.data());
  }
  /// <origin>: translation, then rotations about the fixed axes x, y, z.
  Pose origin_of(const XmlElement& element) {
    const XmlElement* origin = element.child("origin");
    const Vec3 angles = vector(origin, "rpy", Vec3::Zero());
    const auto about = [&](int axis) {
      return Quat(Eigen::AngleAxisd(angles[axis], Vec3(Vec3::Unit(axis))));
    };
    return {vector(origin, "xyz", Vec3::Zero()), (about(2) * about(1) * about(0)).normalized()};
  }

  void read_link(const XmlElement& element) {
    Link link;
    const std::string* name = element.attribute("name");
    if (name == nullptr || name->empty()) return error(element, "a <link> has no name");
    link.name = *name;
    link.place = place(element);
    if (links_.size() == kMaxBodies) return error(element, "too many links");
    if (!indices_.emplace(link.name, static_cast<int>(links_.size())).second) {
      return error(element, "another link is called '" + link.name + "'");
    }
    for (const XmlElement& child : element.children) {
      if (child.name == "inertial") {
        read_inertial(child, link);
      } else if (child.name == "collision") {
        read_shape(child, link);
      } else if (child.name == "visual") {
        report_.left_out.add(place(child), "<visual>: bodies are drawn from their inertia");
      } else {
        report_.left_out.add(place(child), "<" + child.name + "> of a link");
      }
    }
    links_.push_back(std::move(link));
  }

  void read_inertial(const XmlElement& element, Link& link) {
    MassProperties mass;
    mass.mass = number(element.child("mass"), "value", 0.0, not_negative(kMassRange.most, "kg"));
    const XmlElement* inertia = element.child("inertia");
    const auto moment = [&](const char* key) {
      return number(inertia, key, 0.0, symmetric(kInertiaRange.most, "kg m^2"));
    };
    const double xy = moment("ixy");
    const double xz = moment("ixz");
    const double yz = moment("iyz");
    mass.inertia << moment("ixx"), xy, xz, xy, moment("iyy"), yz, xz, yz, moment("izz");
    link.mass = mass.moved(origin_of(element));
    if (mass.mass == 0.0) {
      link.mass.inertia.setZero();
      return;
    }
    const Vec3 moments = principal_axes(mass.inertia).moments;
    if (!(moments.minCoeff() > 0.0)) {
      error(element, "link '" + link.name + "': its moments of inertia are not positive");
    } else if (const auto fault = inertia_fault(moments)) {
      error(element, "link '" + link.name + "': " + *fault);
    }
  }

  void read_shape(const XmlElement& element, Link& link) {
    const XmlElement* geometry = element.child("geometry");
    const XmlElement* shape =
        geometry == nullptr || geometry->children.empty() ? nullptr : &geometry->children.front();
    const Pose pose = origin_of(element);
    if (shape != nullptr && shape->name == "sphere") {
      const double radius = number(shape, "radius", 0.0, not_negative(1e6, "m"));
      link.shapes.push_back({{Solid::Kind::kSphere, Vec3::Constant(radius)}, pose});
    } else if (shape != nullptr && shape->name == "box") {
      const Vec3 size = vector(shape, "size", Vec3::Zero());
      link.shapes.push_back({{Solid::Kind::kBox, 0.5 * size}, pose});
    } else {
      link.has_other_shapes = true;
    }
    if (link.shapes.empty() || link.shapes.back().solid.half.minCoeff() > 0.0) return;
    error(*shape, "<" + shape->name + ">: its sizes must be above 0 (m)");
  }

  /// The two links of a joint.
  void find_links(const XmlElement& element) {
    UrdfJoint joint{&element, -1, -1};
    for (const bool is_child : {false, true}) {
      const char* tag = is_child ? "child" : "parent";
      const XmlElement* end = element.child(tag);
      const std::string* name = end == nullptr ? nullptr : end->attribute("link");
      const auto found = name == nullptr ? indices_.end() : indices_.find(*name);
      if (found == indices_.end()) {
        return error(element, name == nullptr ? "a <joint> has no " + std::string(tag) + " link"
                                              : "no link is called '" + *name + "'");
      }
      (is_child ? joint.child : joint.parent) = found->second;
    }
    if (!above_.emplace(joint.child, joint).second) {
      return error(element,
                   "link '" + links_[index(joint.child)].name + "' is the child of two joints");
    }
    joints_.push_back(joint);
  }

  /// Depth first, in the order of the joints in the file. Links that are not below a root are in a
  /// circle.
  void sort_links() {
    std::vector<std::vector<int>> below(links_.size());
    for (auto joint = joints_.rbegin(); joint != joints_.rend(); ++joint) {
      below[index(joint->parent)].push_back(joint->child);
    }
    std::vector<int> open;
    for (std::size_t i = links_.size(); i-- > 0;) {
      if (!above_.contains(static_cast<int>(i))) open.push_back(static_cast<int>(i));
    }
    std::vector<int> place_of(links_.size());
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      open.insert(open.end(), below[index(i)].begin(), below[index(i)].end());
      place_of[index(i)] = static_cast<int>(mechanism_.links.size());
      Link link = std::move(links_[index(i)]);
      const auto joint = above_.find(i);
      if (joint == above_.end()) {
        set_root(link);
      } else {
        link.parent = place_of[index(joint->second.parent)];
        read_joint(*joint->second.element, link);
      }
      mechanism_.links.push_back(std::move(link));
    }
    if (mechanism_.links.size() != links_.size()) {
      report_.errors.add(place(root_), "the joints of some links form a circle");
    }
  }

  void set_root(Link& link) {
    if (link.name == "world") return;
    if (!options_.free_root) {
      report_.approximated.add(
          link.place, "link '" + link.name + "' is fixed to the world (--free-root frees it)");
      return;
    }
    LinkJoint joint;
    joint.kind = Kind::kFree;
    joint.name = link.name;
    joint.place = link.place;
    link.joints.push_back(joint);
  }

  void read_joint(const XmlElement& element, Link& link) {
    link.pose = origin_of(element);
    const std::string* type = element.attribute("type");
    const std::string kind = type == nullptr ? "" : *type;
    for (const XmlElement& child : element.children) {
      constexpr std::string_view kKnown[] = {"parent", "child",    "origin",
                                             "axis",   "dynamics", "limit"};
      if (std::find(std::begin(kKnown), std::end(kKnown), child.name) != std::end(kKnown)) continue;
      report_.left_out.add(place(child), "<" + child.name + "> of a joint");
    }
    if (kind == "fixed") return;
    LinkJoint joint;
    const std::string* name = element.attribute("name");
    joint.name = name == nullptr ? link.name : *name;
    joint.place = place(element);
    const Vec3 axis = vector(element.child("axis"), "xyz", Vec3::UnitX());
    if (!(axis.norm() > 1e-10)) return error(element, "joint '" + joint.name + "': its axis is 0");
    joint.axis = axis.normalized();
    if (kind == "revolute" || kind == "continuous") {
      joint.kind = Kind::kHinge;
    } else if (kind == "prismatic") {
      joint.kind = Kind::kSlide;
    } else if (kind == "floating") {
      joint.kind = Kind::kFree;
    } else {
      return error(element, "joint '" + joint.name + "': type " +
                                must_be("fixed, revolute, continuous, prismatic or floating",
                                        "'" + kind + "'"));
    }
    if (kind == "revolute" || kind == "prismatic") read_limit(element, joint);
    const XmlElement* dynamics = element.child("dynamics");
    joint.damping = number(dynamics, "damping", 0.0, not_negative(1e12, "N m s/rad or N s/m"));
    joint.friction = number(dynamics, "friction", 0.0, not_negative(1e12, "N m or N"));
    link.joints.push_back(std::move(joint));
  }

  void read_limit(const XmlElement& element, LinkJoint& joint) {
    const XmlElement* limit = element.child("limit");
    if (limit == nullptr) return error(element, "joint '" + joint.name + "' has no <limit>");
    const double lower = number(limit, "lower", 0.0, symmetric(1e6, "rad or m"));
    const double upper = number(limit, "upper", 0.0, symmetric(1e6, "rad or m"));
    report_.left_out.add(place(*limit), "largest effort and velocity: nothing drives the joints");
    if (lower < upper) {
      joint.limit = Limit{lower, upper, 0.0};
    } else {
      report_.left_out.add(place(*limit), "a range whose upper end is not above the lower one");
    }
  }

  const XmlElement& root_;
  std::string file_;
  const ImportOptions& options_;
  ImportReport& report_;
  Mechanism mechanism_;
  std::vector<Link> links_;             // in the order of the file
  std::map<std::string, int> indices_;  // by name
  std::vector<UrdfJoint> joints_;       // in the order of the file
  std::map<int, UrdfJoint> above_;      // the joint of which a link is the child
};

}  // namespace

std::optional<Mechanism> read_urdf(const XmlElement& root, const std::string& file,
                                   const ImportOptions& options, ImportReport& report) {
  Mechanism mechanism = UrdfReader(root, file, options, report).read();
  if (!report.errors.empty()) return std::nullopt;
  return mechanism;
}

}  // namespace substep
