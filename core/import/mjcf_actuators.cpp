// Actuators of joints as drives: force = gain ctrl + bias, with a bias that is linear in the
// joint's coordinate and rate.

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/import/mjcf_model.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr Range kGain = symmetric(1e12, "-");

/// force = gain u - stiffness l - damping dl/dt + constant, in the length l of the actuator.
struct Law {
  double gain = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  double constant = 0.0;
  double damping_ratio = 0.0;  // if above 0, the damping follows from it
};

/// Inertia that a joint turns or moves, in the pose of the model [kg m^2 or kg].
double joint_inertia(const Mechanism& mechanism, const JointIndex& at) {
  const std::vector<Pose> poses = reference_poses(mechanism);
  const LinkJoint& joint = mechanism.links[at.link].joints[at.joint];
  std::vector<char> is_beyond(mechanism.links.size(), 0);
  is_beyond[at.link] = 1;
  MassProperties moved = mechanism.links[at.link].mass.moved(poses[at.link]);
  for (std::size_t i = at.link + 1; i < mechanism.links.size(); ++i) {
    const int parent = mechanism.links[i].parent;
    if (parent < 0 || is_beyond[index(parent)] == 0) continue;
    is_beyond[i] = 1;
    moved += mechanism.links[i].mass.moved(poses[i]);
  }
  if (joint.kind == LinkJoint::Kind::kSlide) return moved.mass + joint.armature;
  const Vec3 axis = poses[at.link].orientation * joint.axis;
  const Vec3 arm = (moved.centre - poses[at.link] * joint.anchor).cross(axis);
  return axis.dot(moved.inertia * axis) + moved.mass * arm.squaredNorm() + joint.armature;
}

class ActuatorReader {
 public:
  ActuatorReader(const MjcfContext& context, MjcfModel& model) : context_(context), model_(model) {}

  void read(const XmlElement& element) {
    MjcfAttributes in(context_, element);
    in.ignore({"group", "lengthrange", "actlimited", "actrange", "ctrllimited", "ctrlrange",
               "forcelimited", "forcerange", "gear"});
    const std::size_t number = count_++;
    const double control = clamped_control(in, number);
    const std::string* name = in.text("joint");
    if (name == nullptr) name = in.text("jointinparent");
    if (name == nullptr) {
      in.ignore({"tendon", "site", "body", "slidersite", "cranksite", "cranklength", "refsite",
                 "kp", "kv", "gainprm", "biasprm", "biastype", "gaintype", "dyntype"});
      return context_.report.left_out.add(in.place(), "an actuator of a tendon, site or body");
    }
    const auto found = model_.joints.find(*name);
    if (found == model_.joints.end()) return in.error("no joint is called '" + *name + "'");
    LinkJoint& joint = model_.joint(found->second);
    std::optional<Law> law = law_of(in);
    if (!law) return;
    if (joint.kind != LinkJoint::Kind::kHinge && joint.kind != LinkJoint::Kind::kSlide) {
      return context_.report.left_out.add(in.place(), "an actuator of a ball or free joint");
    }
    const std::vector<double> gears = in.numbers("gear", 1, 6, kGain);
    const double gear = gears.empty() ? 1.0 : gears.front();
    if (law->damping_ratio > 0.0 && law->stiffness > 0.0 && gear != 0.0) {
      double& inertia = inertias_[{found->second.link, found->second.joint}];
      if (inertia == 0.0) inertia = joint_inertia(model_.mechanism, found->second);
      const double mass = inertia / (gear * gear);
      law->damping = 2.0 * law->damping_ratio * std::sqrt(law->stiffness * mass);
    }
    add_drive(in, *law, gear, control, joint);
  }

 private:
  /// The control at the start, within its range.
  double clamped_control(MjcfAttributes& in, std::size_t number) {
    const double control = number < model_.controls.size() ? model_.controls[number] : 0.0;
    const std::vector<double> range = in.numbers("ctrlrange", 2, 2, kGain);
    const bool is_limited =
        in.choice("ctrllimited").value_or(context_.compiler.autolimits && !range.empty());
    if (!is_limited || range.empty() || !(range[0] <= range[1])) return control;
    return std::clamp(control, range[0], range[1]);
  }

  /// Nothing if it is not one that is read; that is reported.
  std::optional<Law> law_of(MjcfAttributes& in) {
    const std::string& tag = in.element().name;
    const auto leave_out = [&](const std::string& what) {
      context_.report.left_out.add(in.place(), what);
      return std::nullopt;
    };
    Law law;
    if (tag == "motor") {
      law.gain = 1.0;
    } else if (tag == "position") {
      law.gain = law.stiffness = in.number("kp", 1.0, kGain);
      law.damping = in.number("kv", 0.0, kGain);
      law.damping_ratio = in.number("dampratio", 0.0, not_negative(1e6, "-"));
      if (in.number("timeconst", 0.0, not_negative(1e6, "s")) > 0.0) {
        context_.report.approximated.add(in.place(), "an actuator acts without its filter");
      }
      if (in.text("inheritrange") != nullptr) {
        context_.report.approximated.add(in.place(), "a control without its inherited range");
      }
    } else if (tag == "velocity") {
      law.gain = law.damping = in.number("kv", 1.0, kGain);
    } else if (tag == "damper") {
      in.ignore({"kv"});
      return leave_out("an actuator of kind 'damper', without control");
    } else if (tag == "general") {
      if (in.text_or("dyntype", "none") != "none" || in.text_or("gaintype", "fixed") != "fixed") {
        return leave_out("an actuator with dynamics or with a gain that is not fixed");
      }
      const std::string bias = in.text_or("biastype", "none");
      const std::vector<double> gain = in.numbers("gainprm", 1, 10, kGain);
      const std::vector<double> terms = in.numbers("biasprm", 1, 10, kGain);
      law.gain = gain.empty() ? 1.0 : gain.front();
      if (bias == "affine") {
        if (!terms.empty()) law.constant = terms[0];
        if (terms.size() > 1) law.stiffness = -terms[1];
        if (terms.size() > 2) law.damping = -terms[2];
      } else if (bias != "none") {
        return leave_out("an actuator with a bias of type " + bias);
      }
    } else {
      return leave_out("an actuator of kind '" + tag + "'");
    }
    return law;
  }

  /// Actuators of one joint add up.
  void add_drive(MjcfAttributes& in, const Law& law, double gear, double control,
                 LinkJoint& joint) {
    const double stiffness = gear * gear * law.stiffness;
    const double damping = gear * gear * law.damping;
    double force = gear * (law.gain * control + law.constant);
    if (stiffness < 0.0 || damping < 0.0) {
      return context_.report.left_out.add(in.place(), "an actuator with negative gains");
    }
    const std::vector<double> range = in.numbers("forcerange", 2, 2, kGain);
    const bool is_limited =
        in.choice("forcelimited").value_or(context_.compiler.autolimits && !range.empty());
    if (stiffness == 0.0 && damping == 0.0) {
      const bool is_idle = force == 0.0;
      return context_.report.left_out.add(
          in.place(), is_idle ? "a motor, whose control is 0" : "a constant force of an actuator");
    }
    Drive& drive = joint.drive ? *joint.drive : joint.drive.emplace();
    const double sum = drive.stiffness + stiffness;
    if (stiffness > 0.0) {
      drive.target = (drive.stiffness * drive.target + force) / sum;
      force = 0.0;
    }
    if (force != 0.0) {
      drive.velocity = (drive.damping * drive.velocity + force) / (drive.damping + damping);
    }
    drive.stiffness = sum;
    drive.damping += damping;
    if (is_limited && range.size() == 2) {
      const double most = std::abs(gear) * std::max(std::abs(range[0]), std::abs(range[1]));
      if (range[0] != -range[1]) {
        context_.report.approximated.add(in.place(), "a range of forces that is not symmetric");
      }
      if (most > 0.0) drive.effort = drive.effort.value_or(0.0) + most;
    }
  }

  const MjcfContext& context_;
  MjcfModel& model_;
  std::size_t count_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, double> inertias_;  // of joints, once computed
};

}  // namespace

void read_actuators(const MjcfContext& context, MjcfModel& model) {
  ActuatorReader reader(context, model);
  for (const XmlElement& section : context.document.root.children) {
    if (section.name != "actuator") continue;
    for (const XmlElement& element : section.children) reader.read(element);
  }
}

}  // namespace substep
