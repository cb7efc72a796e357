#include "core/import/export_mjcf.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "core/import/kinematic_tree.hpp"
#include "core/import/scene_names.hpp"
#include "core/io/xml_text.hpp"
#include "core/math/angle.hpp"
#include "core/model/format_text.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/number_text.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

// From the world of a scene, Y up, to that of a model, Z up: (x, y, z) becomes (x, -z, y).
Vec3 z_up(const Vec3& v) { return {v.x(), -v.z(), v.y()}; }
const Quat kZUp(std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0, 0.0, 0.0);

constexpr std::size_t kMostExcluded = 100'000;  // pairs that do not collide
constexpr int kDeepest = 450;                   // nested bodies that MuJoCo's XML reader takes

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text += number_text(value == 0.0 ? 0.0 : value);  // no -0
  }
  return text;
}
std::string numbers(std::initializer_list<double> values) { return list(values); }
std::string numbers(const Vec3& v) { return numbers({v.x(), v.y(), v.z()}); }
std::string numbers(const Quat& q) { return numbers({q.w(), q.x(), q.y(), q.z()}); }

/// ` name="value"`
std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

struct WorldPose {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero();
  Vec3 omega = Vec3::Zero();

  [[nodiscard]] Vec3 inward(const Vec3& direction) const { return q.conjugate() * direction; }
};

class MjcfWriter {
 public:
  explicit MjcfWriter(const Scene& scene) : scene_(scene), tree_(KinematicTree::of(scene)) {}

  ExportedModel write() {
    name_bodies();
    find_sites();
    std::string bodies = fixed_bodies();
    bodies += moving_bodies();
    for (const int j : tree_.closing) close(j);
    note_scene();
    const std::string excluded = exclusions();

    std::string& text = out_.text;
    text = "<mujoco" + attribute("model", xml_text(scene_.name)) + ">\n";
    text += "  <compiler angle=\"radian\" autolimits=\"true\"/>\n";
    const Vec3 gravity = scene_.effects.gravity ? z_up(scene_.gravity) : Vec3(Vec3::Zero());
    text += "  <option" + attribute("timestep", number_text(scene_.frame)) +
            attribute("gravity", numbers(gravity)) + ">";
    text += scene_.effects.contact ? "</option>\n" : "<flag contact=\"disable\"/></option>\n";
    text += "  <worldbody>\n" + bodies + "  </worldbody>\n";
    add_section("contact", excluded);
    add_section("tendon", tendons_);
    add_section("equality", equalities_);
    add_section("actuator", actuators_);
    if (moves_) {
      add_section("keyframe", "    <key name=\"start\"" + attribute("qvel", list(rates_)) + "/>\n");
      out_.has_velocities = true;
    }
    text += "</mujoco>\n";
    return std::move(out_);
  }

 private:
  void add_section(const char* name, const std::string& content) {
    if (content.empty()) return;
    out_.text.append("  <").append(name).append(">\n").append(content);
    out_.text.append("  </").append(name).append(">\n");
  }

  [[nodiscard]] const Body& body(int i) const { return scene_.bodies[index(i)]; }
  [[nodiscard]] WorldPose pose_of(int i) const {
    if (i == kWorld) return {};
    const Body& of = body(i);
    if (of.is_static) return {of.position, of.orientation};
    return {of.position, of.orientation, of.velocity, of.angular_velocity};
  }
  static std::string joint_place(const JointBase& joint) { return "joint " + joint.name; }
  [[nodiscard]] std::string body_place(int i) const { return "body " + body(i).name; }

  // Names of a model differ within their kind, and "world" is taken.
  void name_bodies() {
    UniqueNames unique("world");
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const std::string& wanted = scene_.bodies[i].name;
      names_.push_back(unique.unique(wanted));
      if (names_.back() == wanted) continue;
      out_.approximated.add(body_place(static_cast<int>(i)), "is called '" + names_.back() + "'");
    }
  }
  std::string joint_name(const std::string& wanted) {
    std::string name = joint_names_.unique(wanted);
    if (name != wanted) out_.approximated.add("joint " + wanted, "is called '" + name + "'");
    return name;
  }

  // ---- bodies ----

  std::string geom(int i) const {
    const Body& of = body(i);
    std::string text = "<geom";
    if (const auto* sphere = std::get_if<Sphere>(&of.shape)) {
      text += attribute("type", "sphere") + attribute("size", number_text(sphere->radius));
    } else if (const auto* box = std::get_if<Box>(&of.shape)) {
      text += attribute("type", "box") + attribute("size", numbers(box->half_extents));
    } else {  // its normal is z
      text += attribute("type", "plane") + attribute("size", "0 0 1") +
              attribute("quat", numbers(kZUp.conjugate()));
    }
    if (!of.collides || !scene_.effects.contact) {
      text += attribute("contype", "0") + attribute("conaffinity", "0");
    } else if (scene_.effects.friction && of.friction > 0.0) {
      text += attribute("friction", numbers({of.friction, 0.0, 0.0}));
    } else {
      text += attribute("condim", "1");
    }
    if (of.color) {
      const auto part = [&](unsigned shift) { return ((*of.color >> shift) & 0xffU) / 255.0; };
      text += attribute("rgba", numbers({part(16), part(8), part(0), 1.0}));
    }
    return text + "/>";
  }

  std::string fixed_bodies() {
    std::string text;
    for (int i = 0; i < static_cast<int>(scene_.bodies.size()); ++i) {
      if (!body(i).is_static) continue;
      text += "    <body" + attribute("name", xml_text(names_[index(i)])) +
              attribute("pos", numbers(z_up(body(i).position))) +
              attribute("quat", numbers((kZUp * body(i).orientation).normalized())) + ">" +
              geom(i) + "</body>\n";
    }
    return text + world_sites_;
  }

  std::string moving_bodies() {
    std::string text;
    int open = 0;
    for (const KinematicTree::Node& node : tree_.nodes) {
      for (; open >= node.depth; --open) text += indent(open) + "</body>\n";
      if (node.depth > kDeepest) {
        out_.approximated.add(body_place(node.body),
                              "bodies nest deeper than MuJoCo reads, " + std::to_string(kDeepest));
      }
      text += indent(node.depth) + "<body" + attribute("name", xml_text(names_[index(node.body)]));
      text += pose(node) + ">\n";
      const std::string in = indent(node.depth + 1);
      const Body& of = body(node.body);
      text += in + "<inertial pos=\"0 0 0\"" + attribute("mass", number_text(of.mass)) +
              attribute("diaginertia", numbers(of.inertia)) + "/>\n";
      text += joints(node, in);
      text += in + geom(node.body) + "\n" + sites_[index(node.body)];
      open = node.depth;
    }
    for (; open > 0; --open) text += indent(open) + "</body>\n";
    return text;
  }
  static std::string indent(int depth) {
    constexpr int kMost = 20;
    return std::string(2 * static_cast<std::size_t>(std::min(depth, kMost) + 1), ' ');
  }

  /// In the frame of the parent.
  [[nodiscard]] std::string pose(const KinematicTree::Node& node) const {
    const WorldPose own = pose_of(node.body);
    if (node.parent == kWorld) {
      return attribute("pos", numbers(z_up(own.x))) +
             attribute("quat", numbers((kZUp * own.q).normalized()));
    }
    const WorldPose parent = pose_of(node.parent);
    return attribute("pos", numbers(parent.inward(own.x - parent.x))) +
           attribute("quat", numbers((parent.q.conjugate() * own.q).normalized()));
  }

  // ---- joints of the tree ----

  /// A joint as its child sees it.
  struct Hung {
    const Joint& joint;
    bool is_a;        // the child is body a
    WorldPose child;  // at the start
    WorldPose parent;
    Vec3 anchor;  // in the frame of the child

    /// A direction of the child's side, in its frame, or of the parent's.
    [[nodiscard]] Vec3 own(const JointAxes& axes) const { return is_a ? axes.a : axes.b; }
    [[nodiscard]] Vec3 other(const JointAxes& axes) const {
      return child.inward(parent.q * (is_a ? axes.b : axes.a));
    }
    /// The direction about which the coordinate grows, in the frame of the child.
    [[nodiscard]] Vec3 axis() const {
      const JointAxes axes = *axes_of(joint);
      return is_a ? axes.a : Vec3(-axes.b);
    }
    [[nodiscard]] double turning(const Vec3& axis) const {
      return (child.q * axis).dot(child.omega - parent.omega);
    }
    [[nodiscard]] double sliding(const Vec3& axis) const {
      const Vec3 carried = parent.v + parent.omega.cross(child.x - parent.x);
      return (child.q * axis).dot(child.v - carried);
    }
  };

  /// What the parts of a joint measure at the start, where its coordinate in the model is 0.
  struct Starts {
    double limit = 0.0;  // [rad or m]
    double drive = 0.0;
    double spring = 0.0;
  };

  std::string joints(const KinematicTree::Node& node, const std::string& in) {
    const WorldPose child = pose_of(node.body);
    if (node.joint < 0) {
      const Vec3 v = z_up(child.v);
      const Vec3 omega = child.inward(child.omega);
      add_rates({v.x(), v.y(), v.z(), omega.x(), omega.y(), omega.z()});
      return in + "<freejoint/>\n";
    }
    const Joint& joint = scene_.joints[index(node.joint)];
    const JointBase& of = base(joint);
    const bool is_a = of.a == node.body;
    const int other = is_a ? of.b : of.a;
    const Hung hung{joint, is_a, child, pose_of(other), is_a ? of.anchor_a : of.anchor_b};
    note_start(joint, hung);
    note_compliance(joint);
    return std::visit([&](const auto& own) { return joint_text(own, hung, in); }, joint);
  }

  void note_start(const Joint& joint, const Hung& hung) {
    constexpr double kOpen = 1e-9;
    const JointBase& of = base(joint);
    const Vec3 on_child = hung.child.x + hung.child.q * hung.anchor;
    const Vec3 on_parent = hung.parent.x + hung.parent.q * (hung.is_a ? of.anchor_b : of.anchor_a);
    const double gap = gap_of(joint, on_child - on_parent, hung.parent.q).norm();
    if (gap > kOpen * size_of_joint(scene_, of)) {
      out_.approximated.add(joint_place(of), format_text("is open by %.3g m at the start: its "
                                                         "anchor is that of the child",
                                                         gap));
    }
  }

  void note_compliance(const Joint& joint) {
    if (base(joint).compliance > 0.0 || angular_compliance_of(joint).value_or(0.0) > 0.0) {
      out_.approximated.add(joint_place(base(joint)), "is rigid: its compliance is left out");
    }
  }

  void add_rates(std::initializer_list<double> rates) {
    for (const double rate : rates) {
      rates_.push_back(rate);
      moves_ = moves_ || rate != 0.0;
    }
  }

  std::string joint_line(const char* type, const std::string& name, const Hung& hung,
                         const std::optional<Vec3>& axis, const std::string& rest,
                         const std::string& in) {
    std::string text = in + "<joint" + attribute("name", xml_text(name)) + attribute("type", type) +
                       attribute("pos", numbers(hung.anchor));
    if (axis) text += attribute("axis", numbers(*axis));
    return text + rest + "/>\n";
  }

  std::string joint_text(const BallJoint& joint, const Hung& hung, const std::string& in) {
    const Vec3 omega = hung.child.inward(hung.child.omega - hung.parent.omega);
    add_rates({omega.x(), omega.y(), omega.z()});
    return joint_line("ball", joint_name(joint.name), hung, std::nullopt, "", in);
  }

  std::string joint_text(const WeldJoint&, const Hung&, const std::string&) { return ""; }

  std::string joint_text(const HingeJoint& joint, const Hung& hung, const std::string& in) {
    add_rates({hung.turning(hung.axis())});
    const auto from_zero = [&](const AngleZero& zero) {
      const WorldPose& a = hung.is_a ? hung.child : hung.parent;
      const WorldPose& b = hung.is_a ? hung.parent : hung.child;
      return angle_about(a.q * joint.axis_a, b.q * zero.across_b, a.q * zero.across_a);
    };
    Starts starts;
    if (joint.limit) {
      const double middle = 0.5 * (joint.limit->lower + joint.limit->upper);
      starts.limit = middle + wrapped(from_zero(*joint.limit) - middle);
    }
    if (joint.drive) starts.drive = from_zero(*joint.drive);
    if (joint.spring) starts.spring = from_zero(*joint.spring);
    const std::string name = joint_name(joint.name);
    return joint_line("hinge", name, hung, hung.axis(), parts(joint, name, starts), in);
  }

  std::string joint_text(const PrismaticJoint& joint, const Hung& hung, const std::string& in) {
    add_rates({hung.sliding(hung.axis())});
    const std::string name = joint_name(joint.name);
    return joint_line("slide", name, hung, hung.axis(), parts(joint, name, travel_of(joint, hung)),
                      in);
  }

  std::string joint_text(const CylindricalJoint& joint, const Hung& hung, const std::string& in) {
    add_rates({hung.sliding(hung.axis()), hung.turning(hung.axis())});
    const std::string name = joint_name(joint.name);
    return joint_line("slide", name, hung, hung.axis(), parts(joint, name, travel_of(joint, hung)),
                      in) +
           joint_line("hinge", joint_name(joint.name + "_turn"), hung, hung.axis(), "", in);
  }

  // The parent's pin turns first.
  std::string joint_text(const UniversalJoint& joint, const Hung& hung, const std::string& in) {
    const JointAxes axes = *crossing_axes_of(hung.joint);
    const Vec3 first = hung.other(axes);
    const Vec3 second = hung.own(axes);
    add_rates({hung.turning(first), hung.turning(second)});
    return joint_line("hinge", joint_name(joint.name), hung, first, "", in) +
           joint_line("hinge", joint_name(joint.name + "_second"), hung, second, "", in);
  }

  // Never in a tree.
  std::string joint_text(const DistanceJoint&, const Hung&, const std::string&) { return ""; }
  std::string joint_text(const RopeJoint&, const Hung&, const std::string&) { return ""; }

  template <class J>
  Starts travel_of(const J& joint, const Hung& hung) const {
    const WorldPose& a = hung.is_a ? hung.child : hung.parent;
    const WorldPose& b = hung.is_a ? hung.parent : hung.child;
    const Vec3 apart = (a.x + a.q * joint.anchor_a) - (b.x + b.q * joint.anchor_b);
    const double travel = (b.q * joint.axis_b).dot(apart);
    return {travel, travel, travel};
  }

  /// Attributes of a hinge or slide; its actuators are written beside.
  template <class J>
  std::string parts(const J& joint, const std::string& name, const Starts& starts) {
    const Effects& effects = scene_.effects;
    const std::string place = joint_place(joint);
    std::string text;
    if (joint.limit && effects.limits) {
      text += attribute(
          "range", numbers({joint.limit->lower - starts.limit, joint.limit->upper - starts.limit}));
      if (effects.restitution && joint.limit->restitution > 0.0) {
        out_.left_out.add(place, "the restitution of its limits");
      }
    }
    if (joint.spring && effects.springs) {
      if (joint.spring->stiffness > 0.0) {
        text += attribute("stiffness", number_text(joint.spring->stiffness)) +
                attribute("springref", numbers({joint.spring->rest - starts.spring}));
      }
      if (joint.spring->damping > 0.0) {
        text += attribute("damping", number_text(joint.spring->damping));
      }
    }
    double friction = effects.joint_friction ? joint.friction.value_or(0.0) : 0.0;
    if (joint.motor && effects.motors) {
      if (joint.motor->velocity == 0.0) {
        friction += joint.motor->effort;
        out_.approximated.add(place, "its motor at rest is dry friction");
      } else {
        add_motor(*joint.motor, name, place);
      }
    }
    if (friction > 0.0) text += attribute("frictionloss", number_text(friction));
    if (joint.armature && effects.armature) {
      text += attribute("armature", number_text(*joint.armature));
    }
    if (joint.drive && effects.drives) add_drive(*joint.drive, starts.drive, name);
    return text;
  }

  // With a control of 0 it moves as in the scene.
  void add_drive(const Drive& drive, double start, const std::string& joint) {
    const double target = drive.target - start;
    const double k = drive.stiffness;
    const double d = drive.damping;
    const bool is_centred = (k == 0.0 || target == 0.0) && drive.velocity == 0.0;
    std::string law;
    if (is_centred && k > 0.0) {
      law = "position" + names_of_actuator(joint) + attribute("kp", number_text(k)) +
            attribute("kv", number_text(d));
    } else if (is_centred) {
      law = "velocity" + names_of_actuator(joint) + attribute("kv", number_text(d));
    } else {
      law = "general" + names_of_actuator(joint) +
            attribute("gainprm", number_text(k > 0.0 ? k : d)) + attribute("biastype", "affine") +
            attribute("biasprm", numbers({k * target + d * drive.velocity, -k, -d}));
    }
    if (drive.effort) law += attribute("forcerange", numbers({-*drive.effort, *drive.effort}));
    actuators_ += "    <" + law + "/>\n";
  }

  void add_motor(const Motor& motor, const std::string& joint, const std::string& place) {
    constexpr double kSlip = 0.01;  // of the speed, at the largest effort
    const double d = motor.effort / (kSlip * std::abs(motor.velocity));
    actuators_ += "    <general" + names_of_actuator(joint) + attribute("gainprm", number_text(d)) +
                  attribute("biastype", "affine") +
                  attribute("biasprm", numbers({d * motor.velocity, 0.0, -d})) +
                  attribute("forcerange", numbers({-motor.effort, motor.effort})) + "/>\n";
    out_.approximated.add(place, "its motor slips by up to 1 % of its speed");
  }

  std::string names_of_actuator(const std::string& joint) {
    return attribute("name", xml_text(actuator_names_.unique(joint))) +
           attribute("joint", xml_text(joint));
  }

  // ---- loops ----

  /// Ends of rods and ropes.
  void find_sites() {
    sites_.resize(scene_.bodies.size());
    UniqueNames unique;
    for (const int j : tree_.closing) {
      const Joint& joint = scene_.joints[index(j)];
      if (!length_of(joint) && !rope_length_of(joint)) continue;
      const JointBase& of = base(joint);
      for (const bool at_a : {true, false}) {
        const int i = at_a ? of.a : of.b;
        const Vec3& anchor = at_a ? of.anchor_a : of.anchor_b;
        const std::string name = unique.unique(of.name + (at_a ? "_a" : "_b"));
        (at_a ? site_a_ : site_b_)[j] = name;
        const bool is_fixed_end = is_fixed(scene_, i);
        const WorldPose at = pose_of(i);
        const Vec3 pos = is_fixed_end ? z_up(at.x + at.q * anchor) : anchor;
        std::string& text = is_fixed_end ? world_sites_ : sites_[index(i)];
        text += "    <site" + attribute("name", xml_text(name)) + attribute("pos", numbers(pos)) +
                "/>\n";
      }
    }
  }

  void close(int j) {
    const Joint& joint = scene_.joints[index(j)];
    const JointBase& of = base(joint);
    const std::string place = joint_place(of);
    note_compliance(joint);
    if (const std::optional<double> length = length_of(joint)) return add_rod(j, *length);
    if (const std::optional<double> length = rope_length_of(joint)) return add_rope(j, *length);
    if (std::holds_alternative<PrismaticJoint>(joint) ||
        std::holds_alternative<CylindricalJoint>(joint)) {
      out_.left_out.add(place, "a slide that closes a loop");
      return;
    }
    if (std::holds_alternative<WeldJoint>(joint)) return add_weld(of);
    add_connect(of, Vec3::Zero());
    if (const auto* hinge = std::get_if<HingeJoint>(&joint)) {
      add_connect(of, hinge->axis_a * std::max(of.anchor_a.norm(), 0.1));
      note_lost_parts(*hinge, place);
    } else if (std::holds_alternative<UniversalJoint>(joint)) {
      out_.approximated.add(place, "closes a loop as a ball joint");
    }
  }

  void note_lost_parts(const HingeJoint& hinge, const std::string& place) {
    const Effects& effects = scene_.effects;
    std::string lost;
    const auto note = [&](bool is_given, const char* part) {
      if (is_given) lost.append(lost.empty() ? "" : ", ").append(part);
    };
    note(hinge.limit && effects.limits, "limits");
    note(hinge.motor && effects.motors, "motor");
    note(hinge.drive && effects.drives, "drive");
    note(hinge.spring && effects.springs, "spring");
    note(hinge.friction && effects.joint_friction, "dry friction");
    note(hinge.armature && effects.armature, "armature");
    if (!lost.empty()) out_.left_out.add(place, lost + " of a hinge that closes a loop");
  }

  /// body1 and body2 of an equality; the world is body2.
  [[nodiscard]] std::string between(const JointBase& of) const {
    const auto name = [&](int i) {
      return is_fixed(scene_, i) ? std::string("world") : xml_text(names_[index(i)]);
    };
    return attribute("body1", name(of.a)) + attribute("body2", name(of.b));
  }
  std::string equality_name(const JointBase& of) {
    return attribute("name", xml_text(equality_names_.unique(of.name)));
  }

  /// Of a point beside the anchor on a. @param offset in the frame of a
  void add_connect(const JointBase& of, const Vec3& offset) {
    const Vec3 on_a = of.anchor_a + offset;
    const WorldPose a = pose_of(of.a);
    const Vec3 anchor = is_fixed(scene_, of.a) ? z_up(a.x + a.q * on_a) : on_a;
    equalities_ += "    <connect" + equality_name(of) + between(of) +
                   attribute("anchor", numbers(anchor)) + "/>\n";
  }
  void add_weld(const JointBase& of) {
    equalities_ += "    <weld" + equality_name(of) + between(of) + "/>\n";
  }
  std::string tendon(int j, const std::string& rest) {
    const std::string name = tendon_names_.unique(base(scene_.joints[index(j)]).name);
    tendons_ += "    <spatial" + attribute("name", xml_text(name)) + rest + ">" + "<site" +
                attribute("site", xml_text(site_a_[j])) + "/><site" +
                attribute("site", xml_text(site_b_[j])) + "/></spatial>\n";
    return name;
  }
  void add_rod(int j, double length) {
    const JointBase& of = base(scene_.joints[index(j)]);
    const WorldPose a = pose_of(of.a);
    const WorldPose b = pose_of(of.b);
    const double start = ((a.x + a.q * of.anchor_a) - (b.x + b.q * of.anchor_b)).norm();
    const std::string name = tendon(j, "");
    equalities_ += "    <tendon" + equality_name(of) + attribute("tendon1", xml_text(name)) +
                   attribute("polycoef", numbers({length - start, 0.0, 0.0, 0.0, 0.0})) + "/>\n";
  }
  void add_rope(int j, double length) {
    tendon(j, attribute("range", numbers({0.0, length})));
    const Limit* limit = limit_of(scene_.joints[index(j)]);
    if (scene_.effects.restitution && limit != nullptr && limit->restitution > 0.0) {
      out_.left_out.add(joint_place(base(scene_.joints[index(j)])), "the restitution of a rope");
    }
  }

  // ---- contacts and what is left ----

  std::string exclusions() {
    if (!scene_.effects.contact) return "";
    std::string text;
    std::size_t count = 0;
    std::set<std::pair<int, int>> excluded;
    const auto exclude = [&](int i, int j) {
      if (i == kWorld || j == kWorld || !body(i).collides || !body(j).collides) return;
      if (body(i).is_static && body(j).is_static) return;
      if (!excluded.insert(std::minmax(i, j)).second) return;
      if (count++ >= kMostExcluded) return;
      text += "    <exclude" + attribute("body1", xml_text(names_[index(i)])) +
              attribute("body2", xml_text(names_[index(j)])) + "/>\n";
    };
    if (scene_.effects.joints) {
      for (const Joint& joint : scene_.joints) exclude(base(joint).a, base(joint).b);
    }
    std::map<int, std::vector<int>> groups;
    for (int i = 0; i < static_cast<int>(scene_.bodies.size()); ++i) {
      if (body(i).collision_group >= 0 && body(i).collides) {
        groups[body(i).collision_group].push_back(i);
      }
    }
    for (const auto& [group, members] : groups) {
      for (std::size_t i = 0; i < members.size() && count <= kMostExcluded; ++i) {
        for (std::size_t j = i + 1; j < members.size(); ++j) exclude(members[i], members[j]);
      }
    }
    if (count > kMostExcluded) {
      out_.left_out.add(
          "scene", "pairs of bodies that do not collide, beyond " + std::to_string(kMostExcluded));
    }
    return text;
  }

  void note_scene() {
    const Effects& effects = scene_.effects;
    for (int i = 0; i < static_cast<int>(scene_.bodies.size()); ++i) {
      const Body& of = body(i);
      if (effects.external && !of.is_static && !(of.force.isZero(0.0) && of.torque.isZero(0.0))) {
        out_.left_out.add(body_place(i), "a constant force or torque");
      }
      if (effects.contact && effects.restitution && of.collides && of.restitution > 0.0) {
        out_.left_out.add(body_place(i), "its restitution");
      }
    }
    if (effects.contact) {
      out_.approximated.add("scene",
                            "contacts have MuJoCo's softness, and of two friction "
                            "coefficients the larger");
    }
    if (effects.joints && effects.limits && !scene_.joints.empty()) {
      out_.approximated.add("scene", "limits have MuJoCo's softness");
    }
    if (!equalities_.empty()) {
      out_.approximated.add("scene", "joints that close loops have MuJoCo's softness");
    }
    if (!effects.gyroscopic && needs_gyroscopic(scene_)) {
      for (int i = 0; i < static_cast<int>(scene_.bodies.size()); ++i) {
        const Vec3& I = body(i).inertia;
        if (body(i).is_static || (I.x() == I.y() && I.y() == I.z())) continue;
        out_.approximated.add(body_place(i), "has gyroscopic torques, which the scene leaves out");
        break;
      }
    }
  }

  const Scene& scene_;
  KinematicTree tree_;
  ExportedModel out_;
  std::vector<std::string> names_;  // of bodies
  UniqueNames joint_names_;
  UniqueNames actuator_names_;
  UniqueNames equality_names_;
  UniqueNames tendon_names_;
  std::vector<std::string> sites_;  // of bodies
  std::string world_sites_;
  std::map<int, std::string> site_a_;  // of joints
  std::map<int, std::string> site_b_;
  std::string tendons_;
  std::string equalities_;
  std::string actuators_;
  std::vector<double> rates_;  // of the model's coordinates, at the start
  bool moves_ = false;
};

}  // namespace

ExportedModel export_mjcf(const Scene& scene) {
  const auto refused = refusal_of(&scene);
  if (!refused) return MjcfWriter(scene).write();
  ExportedModel none;
  none.left_out.add(scene.name, *refused);
  return none;
}

}  // namespace substep
