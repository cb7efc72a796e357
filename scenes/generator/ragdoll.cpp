#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr double kRagdollMu = 0.6;

/// Builds one doll, upright with its arms out, then rotates it about its pelvis.
class Doll {
 public:
  Doll(int number, std::uint32_t color, const Vec3& pelvis, const Quat& turn, Scene& scene)
      : prefix_("doll_" + std::to_string(number) + "_"),
        color_(color),
        at_(pelvis),
        turn_(turn),
        scene_(scene) {}

  /// @param centre from the pelvis' centre, before the rotation [m]  @return the body's index
  int part(const std::string& name, const Shape& shape, double mass, const Vec3& centre) {
    Body body = solid(prefix_ + name, shape, mass, at_ + turn_ * centre);
    body.orientation = turn_;
    body.friction = kRagdollMu;
    body.color = color_;
    centres_.push_back(centre);
    scene_.bodies.push_back(body);
    return static_cast<int>(scene_.bodies.size()) - 1;
  }
  /// A joint between two parts at a point from the pelvis' centre, before the rotation.
  template <class Joint>
  Joint& join(const std::string& name, int a, int b, const Vec3& point) {
    Joint joint;
    joint.name = prefix_ + name;
    joint.a = a;
    joint.b = b;
    joint.anchor_a = point - centre(a);
    joint.anchor_b = point - centre(b);
    scene_.joints.emplace_back(joint);
    return std::get<Joint>(scene_.joints.back());
  }

 private:
  [[nodiscard]] const Vec3& centre(int body) const {
    return centres_[static_cast<std::size_t>(body) + centres_.size() - scene_.bodies.size()];
  }

  std::string prefix_;
  std::uint32_t color_;
  Vec3 at_;
  Quat turn_;
  Scene& scene_;
  std::vector<Vec3> centres_;  // of the parts, before the rotation [m]
};

void hinge_about(HingeJoint& hinge, const Vec3& axis) { hinge.axis_a = hinge.axis_b = axis; }

void add_doll(int number, std::uint32_t color, const Vec3& at, const Quat& turn, Scene& scene) {
  Doll doll(number, color, at, turn, scene);
  const int pelvis = doll.part("pelvis", box(0.32, 0.18, 0.20), 10.0, {0.0, 0.0, 0.0});
  const int chest = doll.part("chest", box(0.38, 0.38, 0.22), 18.0, {0.0, 0.31, 0.0});
  const int head = doll.part("head", Sphere{0.13}, 5.0, {0.0, 0.68, 0.0});
  doll.join<BallJoint>("waist", chest, pelvis, {0.0, 0.105, 0.0});
  doll.join<BallJoint>("neck", head, chest, {0.0, 0.53, 0.0});
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0.0 ? "left_" : "right_";
    const int upper =
        doll.part(which + "upper_arm", box(0.30, 0.10, 0.10), 2.5, {side * 0.37, 0.44, 0.0});
    const int lower =
        doll.part(which + "forearm", box(0.30, 0.09, 0.09), 2.0, {side * 0.69, 0.44, 0.0});
    doll.join<BallJoint>(which + "shoulder", upper, chest, {side * 0.205, 0.44, 0.0});
    hinge_about(doll.join<HingeJoint>(which + "elbow", lower, upper, {side * 0.53, 0.44, 0.0}),
                Vec3::UnitY());
    const int thigh =
        doll.part(which + "thigh", box(0.14, 0.42, 0.15), 7.0, {side * 0.10, -0.32, 0.0});
    const int shin =
        doll.part(which + "shin", box(0.12, 0.44, 0.13), 5.0, {side * 0.10, -0.77, 0.0});
    doll.join<BallJoint>(which + "hip", thigh, pelvis, {side * 0.10, -0.10, 0.0});
    hinge_about(doll.join<HingeJoint>(which + "knee", shin, thigh, {side * 0.10, -0.54, 0.0}),
                Vec3::UnitX());
  }
}

}  // namespace

Scene ragdoll_drop() {
  Scene scene = paper_scene();
  scene.name = "ragdoll_drop";
  scene.title = "Ragdolls";
  scene.group = "playground";
  scene.description = "Four dolls of 11 parts each fall down a flight of steps.";
  scene.look_for =
      "Joints and contacts together: a landing needs many sub-steps, tumbling needs few.";
  scene.effects = {
      .gravity = true, .gyroscopic = true, .joints = true, .contact = true, .friction = true};
  add_ground(kRagdollMu, 0.01, scene);
  constexpr int kSteps = 4;
  for (int i = 0; i < kSteps; ++i) {
    const double height = 0.4 * (kSteps - i);
    Body step;
    step.name = "step_" + std::to_string(i);
    step.shape = box(0.9, height, 3.6);
    step.position = {-2.0 + 0.9 * i, 0.5 * height, 0.0};
    step.is_static = true;
    step.friction = kRagdollMu;
    scene.bodies.push_back(step);
  }
  const Quat upright = Quat::Identity();
  const Quat leaning = turn_about_z(0.8, -0.6);  // head to +x, down the steps
  const Quat lying = turn_about_z(0.0, 1.0);
  add_doll(0, kBlue, {-1.6, 3.2, -0.9}, leaning, scene);
  add_doll(1, kTeal, {-1.9, 3.6, 0.9}, upright, scene);
  add_doll(2, kRose, {-1.4, 5.2, -0.2}, lying, scene);
  add_doll(3, kViolet, {-1.2, 6.6, 0.3}, leaning.conjugate(), scene);
  scene.camera.eye = {5.2, 3.6, 7.4};
  scene.camera.target = {-0.3, 1.6, 0.0};
  return scene;
}

}  // namespace substep::scenes
