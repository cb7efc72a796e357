#pragma once
// All values of a scene as two flat lists, to compare scenes bit for bit.

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/joint_fields.hpp"
#include "core/model/scene.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {

struct SceneBits {
  std::vector<std::string> words;
  std::vector<std::uint64_t> numbers;

  friend bool operator==(const SceneBits&, const SceneBits&) = default;
};

class SceneBitsWriter {
 public:
  void add(const std::string& word) { bits_.words.push_back(word); }
  void add(double x) { bits_.numbers.push_back(std::bit_cast<std::uint64_t>(x)); }
  void add(int i) { bits_.numbers.push_back(static_cast<std::uint64_t>(i)); }
  void add(bool b) { bits_.numbers.push_back(b ? 1U : 0U); }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Quat& q) {
    for (int i = 0; i < 4; ++i) add(q.coeffs()[i]);
  }
  template <class T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  void add(const Criteria::Displacement& d) {
    add(d.body);
    add(d.distance);
  }
  void add(const Shape& shape) {
    add(static_cast<int>(shape.index()));
    if (const auto* sphere = std::get_if<Sphere>(&shape)) add(sphere->radius);
    if (const auto* box = std::get_if<Box>(&shape)) add(box->half_extents);
  }
  void add(const Effects& e) {
    for (const bool b :
         {e.gravity, e.gyroscopic, e.joints, e.contact, e.friction, e.restitution, e.external,
          e.limits, e.motors, e.drives, e.joint_friction, e.armature, e.springs})
      add(b);
  }
  void add(const Body& b) {
    add(b.name);
    add(b.shape);
    add(b.is_static);
    add(b.mass);
    add(b.inertia);
    add(b.position);
    add(b.orientation);
    add(b.velocity);
    add(b.angular_velocity);
    add(b.force);
    add(b.torque);
    add(b.friction);
    add(b.restitution);
    add(b.collision_group);
    add(b.collides);
    add(b.color ? static_cast<int>(*b.color) : -1);
  }
  void add(const Joint& joint) {
    const JointBase& j = base(joint);
    add(static_cast<int>(joint.index()));
    add(j.name);
    add(j.a);
    add(j.b);
    add(j.anchor_a);
    add(j.anchor_b);
    add(j.compliance);
    if (const auto* hinge = std::get_if<HingeJoint>(&joint)) {
      add(hinge->axis_a);
      add(hinge->axis_b);
      add(hinge->angular_compliance);
    }
    if (const AngleLimit* limit = angle_limit_of(joint)) {
      add(limit->across_a);
      add(limit->across_b);
    }
    if (const Limit* limit = limit_of(joint)) {
      for (const double x : {limit->lower, limit->upper, limit->restitution}) add(x);
    }
    if (const Motor* motor = motor_of(joint)) {
      add(motor->velocity);
      add(motor->effort);
    }
    add(friction_of(joint).value_or(0.0));
    add(armature_of(joint));
    if (const AngularDrive* drive = angular_drive_of(joint)) {
      add(drive->across_a);
      add(drive->across_b);
    }
    if (const AngularSpring* spring = angular_spring_of(joint)) {
      add(spring->across_a);
      add(spring->across_b);
    }
    if (const Spring* spring = spring_of(joint)) {
      for (const double x : {spring->rest, spring->stiffness, spring->damping}) add(x);
    }
    if (const Drive* drive = drive_of(joint)) {
      for (const double x : {drive->target, drive->velocity, drive->stiffness, drive->damping,
                             drive->effort.value_or(-1.0)})
        add(x);
    }
  }
  SceneBits take() { return std::move(bits_); }

 private:
  SceneBits bits_;
};

/// Settings are omitted: they compare by ==.
inline SceneBits bits_of(const Scene& s) {
  SceneBitsWriter out;
  for (const std::string* word : {&s.name, &s.title, &s.group, &s.description, &s.look_for}) {
    out.add(*word);
  }
  out.add(s.frame);
  out.add(s.gravity);
  out.add(s.effects);
  for (const Body& body : s.bodies) out.add(body);
  for (const Joint& joint : s.joints) out.add(joint);
  out.add(s.contact.compliance);
  out.add(s.contact.friction_compliance);
  out.add(s.contact.margin);
  out.add(s.contact.restitution_speed);
  out.add(s.contact.soft_compliance);
  out.add(s.regularisation);
  out.add(static_cast<int>(s.start));
  out.add(s.criteria.duration);
  out.add(s.criteria.joint_gap);
  out.add(s.criteria.energy_gain);
  out.add(s.criteria.energy_scale);
  out.add(s.criteria.displacement);
  out.add(s.criteria.track);
  out.add(s.criteria.holds);
  out.add(s.camera.eye);
  out.add(s.camera.target);
  return out.take();
}

}  // namespace substep::test
