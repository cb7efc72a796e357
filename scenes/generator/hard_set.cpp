#include "scenes/generator/hard_set.hpp"

#include <string>
#include <utility>

#include "core/math/random.hpp"
#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr double kHardLink = 0.4;  // length of a link [m]
constexpr double kHeavy = 1e3;     // load of a chain [kg]
constexpr Angle kFold{0.8, 0.6};   // of folded chains to the vertical

Scene named(Scene scene, const std::string& name, double duration) {
  scene.name = name;
  scene.title = name;
  scene.group = "hard";
  scene.criteria.duration = duration;
  return scene;
}

/// The permitted increase of energy: half of that which lifts everything by 1 m, and a tenth of the
/// kinetic energy.
void forbid_gain(Scene& scene) {
  double limit = 0.0;
  for (const Body& body : scene.bodies) {
    if (body.is_static) continue;
    limit += 0.5 * body.mass * scene.gravity.norm() * 1.0;
    limit += 0.1 * 0.5 * body.mass * body.velocity.squaredNorm();
  }
  scene.criteria.energy_gain = limit;
}

/// A chain of bodies on ball joints in the plane z = 0, starting at a point of the world.
class LinkChain {
 public:
  LinkChain(const Vec3& anchor, Scene& scene) : scene_(scene), end_(anchor), anchor_(anchor) {}

  /// Appends a body that reaches `length` along `direction`, a unit vector. @return its index
  int add(const std::string& name, const Shape& shape, double mass, double length,
          const Vec3& direction) {
    Body body = solid(name + "_" + std::to_string(scene_.bodies.size()), shape, mass,
                      end_ + 0.5 * length * direction);
    body.orientation = turn_about_z(direction.x(), direction.y());
    const int index = static_cast<int>(scene_.bodies.size());
    scene_.bodies.push_back(std::move(body));
    join(index, {-0.5 * length, 0.0, 0.0}, last_, last_ == kWorld ? anchor_ : last_end_);
    last_ = index;
    last_end_ = {0.5 * length, 0.0, 0.0};
    end_ += length * direction;
    return index;
  }
  void links(int n, const Vec3& direction) {
    for (int i = 0; i < n; ++i) add("link", box(kHardLink, 0.1, 0.1), 1.0, kHardLink, direction);
  }
  /// Joins the end to the world at its position.
  void fix_end() { join(last_, last_end_, kWorld, end_); }
  /// Joins the end to a point of another body.
  void join_end(int body, const Vec3& anchor) { join(last_, last_end_, body, anchor); }

 private:
  void join(int a, const Vec3& anchor_a, int b, const Vec3& anchor_b) {
    BallJoint joint;
    joint.name = "joint_" + std::to_string(scene_.joints.size());
    joint.a = a;
    joint.b = b;
    joint.anchor_a = anchor_a;
    joint.anchor_b = anchor_b;
    joint.compliance = 1e-10;
    scene_.joints.emplace_back(joint);
  }

  Scene& scene_;
  Vec3 end_;     // where the chain ends [m]
  Vec3 anchor_;  // of the first body, in the world [m]
  int last_ = kWorld;
  Vec3 last_end_ = Vec3::Zero();  // in the frame of the last body [m]
};

Scene empty() {
  Scene scene = paper_scene();
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  return scene;
}

Scene mass_ratio(double mass) {
  Scene scene = rope_of_n({.end_mass = mass});
  forbid_gain(scene);
  return scene;
}

Scene rope(int n) {
  Scene scene = rope_of_n({.n = n});
  forbid_gain(scene);
  return scene;
}

Scene swing_from(const Angle& angle) {
  Scene scene = swinging_box({.angle = angle});
  forbid_gain(scene);
  return scene;
}

/// A chain folded to six tenths of its length, with the box below: it falls and snaps taut.
Scene slack(int links) {
  Scene scene = empty();
  LinkChain chain({0.0, 12.0, 0.0}, scene);
  for (int i = 0; i < links; ++i) {
    chain.links(1, {i % 2 == 0 ? kFold.sine : -kFold.sine, -kFold.cosine, 0.0});
  }
  chain.add("box", box(1.0, 1.0, 1.0), kHeavy, 1.0, {0.0, -1.0, 0.0});
  forbid_gain(scene);
  return scene;
}

Scene two_boxes(double upper, double lower) {
  Scene scene = empty();
  LinkChain chain({0.0, 12.0, 0.0}, scene);
  const Vec3 direction{kFold.sine, -kFold.cosine, 0.0};
  chain.links(10, direction);
  chain.add("upper", box(0.8, 0.8, 0.8), upper, 0.8, direction);
  chain.links(10, direction);
  chain.add("lower", box(0.8, 0.8, 0.8), lower, 0.8, direction);
  forbid_gain(scene);
  return scene;
}

/// A chain suspended at both ends with a weight in the middle: it falls by the slack of the V and
/// swings.
Scene both_ends() {
  Scene scene = empty();
  LinkChain chain({-5.0, 10.0, 0.0}, scene);
  chain.links(12, {0.8, -0.6, 0.0});
  chain.add("weight", box(0.6, 0.6, 0.6), kHeavy, 0.6, {1.0, 0.0, 0.0});
  chain.links(12, {0.6, 0.8, 0.0});
  chain.fix_end();
  forbid_gain(scene);
  return scene;
}

/// A closed ring of 24 links, suspended at one corner, with a weight at the opposite one.
Scene ring() {
  Scene scene = empty();
  LinkChain chain({0.0, 12.0, 0.0}, scene);
  const int first = static_cast<int>(scene.bodies.size());
  chain.links(6, {0.8, -0.6, 0.0});
  chain.links(6, {-0.8, -0.6, 0.0});
  const int lowest = static_cast<int>(scene.bodies.size()) - 1;
  chain.links(6, {-0.8, 0.6, 0.0});
  chain.links(6, {0.8, 0.6, 0.0});
  chain.join_end(first, {-0.5 * kHardLink, 0.0, 0.0});
  Body weight =
      solid("weight", Sphere{0.3}, kHeavy, {0.0, 12.0 - 12.0 * 0.6 * kHardLink - 0.3, 0.0});
  BallJoint joint;
  joint.name = "hook";
  joint.a = static_cast<int>(scene.bodies.size());
  joint.b = lowest;
  joint.anchor_a = {0.0, 0.3, 0.0};
  joint.anchor_b = {0.5 * kHardLink, 0.0, 0.0};
  joint.compliance = 1e-10;
  scene.bodies.push_back(weight);
  scene.joints.emplace_back(joint);
  forbid_gain(scene);
  return scene;
}

/// A rope of links with another cross-section.
Scene links_of(double height, double depth) {
  Scene scene = rope_of_n({});
  for (Body& body : scene.bodies) {
    if (!body.name.starts_with("link")) continue;
    body.shape = box(kHardLink, height, depth);
    body.inertia = solid_inertia(body.shape, body.mass);
  }
  forbid_gain(scene);
  return scene;
}

/// Every link starts with a different velocity of up to 5 m/s, which the joints do not permit. The
/// start is kept, to test how a method handles it.
Scene inconsistent() {
  Scene scene = swinging_box();
  scene.start = StartPolicy::kKeep;
  Random random(5);
  for (Body& body : scene.bodies) {
    if (!body.name.starts_with("link")) continue;
    for (int axis = 0; axis < 2; ++axis) body.velocity[axis] = 5.0 * random.next();
  }
  forbid_gain(scene);
  return scene;
}

/// The heavy box starts at 20 m/s across a chain at rest, or along it. The impact acts on the chain
/// in the first sub-step, not before it.
Scene yanked(const Vec3& velocity) {
  Scene scene = swinging_box();
  scene.start = StartPolicy::kKeep;
  scene.bodies.back().velocity = velocity;
  forbid_gain(scene);
  return scene;
}

Scene bridge_with(double friction) {
  Scene scene = bridge();
  for (Body& body : scene.bodies) body.friction = friction;
  forbid_gain(scene);
  return scene;
}

/// The ball lands on the middle planks of the bridge at 30 m/s.
Scene landing_on_bridge() {
  Scene scene = bridge();
  Body& ball = scene.bodies.back();
  ball.position = {0.0, 6.0, 0.0};
  ball.velocity = {0.0, -30.0, 0.0};
  ball.angular_velocity = Vec3::Zero();
  forbid_gain(scene);
  return scene;
}

/// A crate of 1000 kg lands at 30 m/s on a light plank that lies on two supports.
Scene landing_on_plank() {
  Scene scene = paper_scene();
  scene.effects = {.gravity = true, .gyroscopic = true, .contact = true, .friction = true};
  scene.contact.compliance = 1e-8;
  scene.bodies.push_back(floor_plane());
  const auto add = [&](Body body) {
    body.friction = 0.5;
    scene.bodies.push_back(std::move(body));
  };
  for (const double x : {-1.5, 1.5}) {
    Body support = solid(x < 0.0 ? "left" : "right", box(0.5, 1.0, 1.0), 1.0, {x, 0.5, 0.0});
    support.is_static = true;
    add(std::move(support));
  }
  add(solid("plank", box(4.0, 0.1, 1.0), 5.0, {0.0, 1.05, 0.0}));
  Body crate = solid("crate", box(0.8, 0.8, 0.8), kHeavy, {0.0, 2.5, 0.0});
  crate.velocity = {0.0, -30.0, 0.0};
  add(std::move(crate));
  scene.bodies[0].friction = 0.5;
  forbid_gain(scene);
  return scene;
}

Scene stack_of(int layers) { return heavy_stack({.layers = layers}); }

Scene with_frame(Scene scene, double per_second) {
  scene.frame = 1.0 / per_second;
  return scene;
}

Scene moved(Scene scene, const Vec3& by) {
  for (Body& body : scene.bodies) body.position += by;
  for (Joint& joint : scene.joints) {
    if (base(joint).b == kWorld) base(joint).anchor_b += by;
  }
  return scene;
}

}  // namespace

std::vector<HardCase> hard_set() {
  std::vector<HardCase> set;
  const auto add = [&](const char* family, const std::string& name, double duration, Scene scene) {
    set.push_back({family, named(std::move(scene), name, duration)});
  };
  for (const int power : {0, 1, 2, 3, 4, 5, 6}) {
    double mass = 1.0;
    for (int i = 0; i < power; ++i) mass *= 10.0;
    add("mass ratio", "mass_ratio_1e" + std::to_string(power), 4.0, mass_ratio(mass));
  }
  add("ropes", "rope_of_10", 4.0, rope(10));
  add("ropes", "rope_of_100", 1.5, rope(100));
  add("ropes", "rope_of_500", 0.3, rope(500));
  add("ropes", "rope_of_2000", 0.1, rope(2000));
  for (const int layers : {5, 10, 20, 40}) {
    add("stacks", "stack_of_" + std::to_string(layers), layers > 20 ? 0.5 : 1.5, stack_of(layers));
  }
  add("angles", "swing_from_0", 4.0, swing_from({0.0, 1.0}));
  add("angles", "swing_from_37", 4.0, swing_from({0.6, 0.8}));
  add("angles", "swing_from_60", 4.0, swing_from(kSixtyDegrees));
  add("angles", "swing_from_90", 4.0, swing_from({1.0, 0.0}));
  add("slack chains", "slack_of_8", 3.0, slack(8));
  add("slack chains", "slack_of_24", 3.0, slack(24));
  add("two boxes", "two_boxes_500_500", 4.0, two_boxes(500.0, 500.0));
  add("two boxes", "two_boxes_1000_10", 4.0, two_boxes(1000.0, 10.0));
  add("two boxes", "two_boxes_10_1000", 4.0, two_boxes(10.0, 1000.0));
  add("loops", "both_ends", 4.0, both_ends());
  add("loops", "ring", 4.0, ring());
  add("playground", "ragdoll_heap", 4.0, ragdoll_drop());
  add("playground", "wrecking_ball", 4.0, wrecking_ball());
  add("playground", "card_house_4", 2.0, card_house(4));
  add("playground", "card_house_6", 2.0, card_house(6));
  add("impacts", "landing_on_plank", 2.0, landing_on_plank());
  add("impacts", "landing_on_bridge", 2.0, landing_on_bridge());
  add("friction", "bridge_friction_0", 4.0, bridge_with(0.0));
  add("friction", "bridge_friction_0_8", 4.0, bridge_with(0.8));
  add("friction", "bridge_friction_2", 4.0, bridge_with(2.0));
  for (const int rate : {30, 120, 240}) {
    const std::string at = "_at_" + std::to_string(rate) + "_hz";
    add("frames", "swinging_box" + at, 3.0, with_frame(swing_from(kSixtyDegrees), rate));
    add("frames", "bridge" + at, 3.0, with_frame(bridge_with(0.8), rate));
  }
  const Vec3 away{1000.0, 0.0, -700.0};
  add("far away", "swinging_box_far", 4.0, moved(swing_from(kSixtyDegrees), away));
  add("far away", "bridge_far", 3.0, moved(bridge_with(0.8), away));
  add("inertia", "needles", 3.0, links_of(0.02, 0.02));
  add("inertia", "plates", 3.0, links_of(0.4, 0.01));
  add("starts", "inconsistent_start", 3.0, inconsistent());
  add("starts", "yanked_across", 3.0, yanked({10.0, 17.320508075688775, 0.0}));
  add("starts", "yanked_sideways", 3.0, yanked({0.0, 0.0, 20.0}));
  add("starts", "yanked_along", 3.0, yanked({17.320508075688775, -10.0, 0.0}));
  return set;
}

}  // namespace substep::scenes
