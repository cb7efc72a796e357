#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "core/import/joint_stack.hpp"
#include "core/import/mechanism.hpp"
#include "core/import/scene_names.hpp"
#include "core/model/effects.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_builder.hpp"

namespace substep {
namespace {

using JointKind = LinkJoint::Kind;

/// From the world of a model, Z up, to that of a scene, Y up: (x, y, z) becomes (x, z, -y).
const Pose kYUp{Vec3::Zero(), Quat(std::numbers::sqrt2 / 2.0, -std::numbers::sqrt2 / 2.0, 0, 0)};
Vec3 y_up(const Vec3& v) { return {v.x(), v.z(), -v.y()}; }
Pose y_up(const Pose& pose) {
  return {y_up(pose.position), (kYUp.orientation * pose.orientation).normalized()};
}

Quat turn_about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); }

/// A link in motion at the start.
struct Motion {
  Pose pose;
  Vec3 velocity = Vec3::Zero();          // of its origin, world [m/s]
  Vec3 angular_velocity = Vec3::Zero();  // world [rad/s]
};

/// The link after its joints have moved it, and where these stand. @param parent that of its parent
Motion moved_by_joints(const Motion& parent, const Link& link, std::vector<PlacedJoint>& placed) {
  Motion motion;
  Pose& pose = motion.pose;
  pose = parent.pose * link.pose;
  for (const LinkJoint& joint : link.joints) {
    const Vec3 anchor = pose * joint.anchor;
    const Vec3 axis = pose.orientation * joint.axis;
    placed.push_back({&joint, anchor, axis});
    const double by = joint.start - joint.reference;
    if (joint.kind == JointKind::kSlide) {
      pose.position += by * axis;
    } else if (joint.kind == JointKind::kFree) {
      if (link.free_start) pose = *link.free_start;
    } else {
      Quat turn = Quat::Identity();
      if (joint.kind == JointKind::kHinge) turn = turn_about(joint.axis, by);
      if (joint.kind == JointKind::kBall && link.ball_start) turn = *link.ball_start;
      pose.orientation = (pose.orientation * turn).normalized();
      pose.position = anchor - pose.orientation * joint.anchor;
    }
  }
  Vec3& v = motion.velocity;
  Vec3& w = motion.angular_velocity;
  w = parent.angular_velocity;
  v = parent.velocity + w.cross(pose.position - parent.pose.position);
  for (const PlacedJoint& at : placed) {
    const auto turn = [&](const Vec3& by) {
      w += by;
      v += by.cross(pose.position - at.anchor);
    };
    switch (at.joint->kind) {
      case JointKind::kHinge:
        turn(at.joint->rate * at.axis);
        break;
      case JointKind::kSlide:
        v += at.joint->rate * at.axis;
        break;
      case JointKind::kBall:
        turn(pose.orientation * link.free_angular_velocity);
        break;
      case JointKind::kFree:
        v = link.free_velocity;
        w = pose.orientation * link.free_angular_velocity;
        break;
    }
  }
  return motion;
}

/// A joint that starts outside its range starts at its nearer end: a scene could not begin there.
void start_within_limits(Mechanism& mechanism, ImportReport& report) {
  for (Link& link : mechanism.links) {
    if (link.joints.size() != 1) continue;  // limits of several in one place are not kept
    LinkJoint& joint = link.joints.front();
    if (!joint.limit || !(joint.limit->lower < joint.limit->upper)) continue;
    const double within = std::clamp(joint.start, joint.limit->lower, joint.limit->upper);
    if (within == joint.start) continue;
    report.approximated.add(
        joint.place, "joint '" + joint.name + "' starts at " + number_text(joint.start) +
                         ", outside its range from " + number_text(joint.limit->lower) + " to " +
                         number_text(joint.limit->upper) + ": it starts at " + number_text(within));
    joint.start = within;
  }
}

class Assembly {
 public:
  Assembly(Mechanism mechanism, const ImportOptions& options, ImportReport& report,
           ScenePlaces& places)
      : model_(std::move(mechanism)), options_(options), report_(report), places_(places) {}

  Scene scene() {
    start_within_limits(model_, report_);
    find_roots();
    joined_.assign(model_.links.size(), false);
    if (model_.joins_massless) join_massless_links();
    place_links();
    add_ground();
    for (std::size_t i = 0; i < model_.links.size(); ++i) add_body(i);
    for (std::size_t i = 0; i < model_.links.size(); ++i) add_joints(i);
    for (const LinkLoop& loop : model_.loops) add_loop(loop);
    finish();
    Scene scene = *builder_.build();
    scene.effects.friction = scene.effects.friction && scene.effects.contact;
    return scene;
  }

 private:
  Link& link(int i) { return model_.links[index(i)]; }
  [[nodiscard]] bool moves(std::size_t i) const { return roots_[i] == static_cast<int>(i); }
  [[nodiscard]] bool is_static(std::size_t i) const { return roots_[i] == -1; }

  /// Which link each link is a part of, and where.
  void find_roots() {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      const Link& l = model_.links[i];
      const bool has_parent = l.parent >= 0;
      if (!l.joints.empty()) {
        roots_.push_back(static_cast<int>(i));
        in_root_.emplace_back();
      } else {
        roots_.push_back(has_parent ? roots_[index(l.parent)] : -1);
        in_root_.push_back(has_parent ? in_root_[index(l.parent)] * l.pose : l.pose);
        if (roots_.back() >= 0) ++parts_;
      }
    }
    masses_.resize(model_.links.size());
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (!is_static(i)) masses_[index(roots_[i])] += model_.links[i].mass.moved(in_root_[i]);
    }
  }

  [[nodiscard]] int parent_root(std::size_t i) const {
    const int parent = model_.links[i].parent;
    return parent < 0 ? -1 : roots_[index(parent)];
  }

  /// A link without mass and with one link beyond it: its joints are the first ones of that link.
  void join_massless_links() {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (!moves(i) || masses_[i].mass > 0.0) continue;
      std::vector<std::size_t> beyond;
      for (std::size_t j = i + 1; j < model_.links.size(); ++j) {
        if (moves(j) && parent_root(j) == static_cast<int>(i)) beyond.push_back(j);
      }
      const auto is_at = [&](const LinkLoop& loop) {
        return is_part(loop.a, i) || is_part(loop.b, i);
      };
      const bool has_loop = std::any_of(model_.loops.begin(), model_.loops.end(), is_at);
      if (beyond.size() != 1 || has_loop) continue;
      Link& own = model_.links[i];
      Link& next = model_.links[beyond.front()];
      const Pose to_next = in_root_[index(next.parent)] * next.pose;
      std::vector<LinkJoint> joints = own.joints;
      for (LinkJoint& joint : joints) {
        joint.anchor = to_next.inverse() * joint.anchor;
        joint.axis = to_next.orientation.conjugate() * joint.axis;
      }
      next.joints.insert(next.joints.begin(), joints.begin(), joints.end());
      next.pose = own.pose * to_next;
      next.parent = own.parent;
      joined_[i] = true;
    }
  }
  [[nodiscard]] bool is_part(int i, std::size_t of) const {
    return i >= 0 && roots_[index(i)] == static_cast<int>(of);
  }

  void place_links() {
    motions_.resize(model_.links.size());
    placed_.resize(model_.links.size());
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      const Link& l = model_.links[i];
      const Motion parent = l.parent < 0 ? Motion() : motions_[index(l.parent)];
      motions_[i] = moved_by_joints(parent, l, placed_[i]);
    }
  }

  void add_ground() {
    for (const GroundPlane& ground : model_.grounds) {
      const int i = builder_.add_fixed(Plane{}, y_up(ground.pose.position));
      Body& body = builder_.body(i);
      const Quat z_from_y = turn_about(Vec3::UnitX(), std::numbers::pi / 2.0);
      body.orientation = (y_up(ground.pose).orientation * z_from_y).normalized();
      body.friction = ground.friction;
      finish_body(i, ground.name, ground.place, options_.collide);
      note_collision(ground.place);
    }
  }

  void finish_body(int i, const std::string& name, const std::string& place, bool collides) {
    Body& body = builder_.body(i);
    body.name = body_names_.unique(name);
    body.collides = collides;
    places_.bodies.push_back(place);
  }

  void note_collision(const std::string& place) {
    if (options_.collide) return;
    report_.left_out.add(place, "collisions of a sphere, box or plane (--collide)");
  }

  void add_body(std::size_t i) {
    bodies_.push_back(kWorld);
    frames_.emplace_back();
    if (is_static(i)) return add_static(i);
    if (!moves(i) || joined_[i]) return;
    const Link& l = model_.links[i];
    const MassProperties& solid = masses_[i];
    if (!(solid.mass > 0.0)) {
      std::string text = "body '" + l.name + "' moves but has no mass";
      report_.errors.add(l.place, l.without_mass.empty() ? text : text + ": " + l.without_mass);
      return;
    }
    const PrincipalAxes axes = principal_axes(solid.inertia);
    Pose frame{solid.centre, axes.orientation};
    Shape shape = Box{equivalent_box(solid.mass, axes.moments)};
    Vec3 moments = axes.moments;
    const bool is_exact = own_shape(i, frame, shape, moments);
    const int body = builder_.add_body(shape, solid.mass, Vec3::Zero());
    bodies_.back() = body;
    frames_.back() = frame;
    Body& made = builder_.body(body);
    const Motion& motion = motions_[i];
    const Pose pose = y_up(motion.pose * frame);
    made.position = pose.position;
    made.orientation = pose.orientation;
    made.inertia = moments;
    const Vec3 arm = motion.pose.orientation * frame.position;
    made.velocity = y_up(motion.velocity + motion.angular_velocity.cross(arm));
    made.angular_velocity = y_up(motion.angular_velocity);
    if (is_exact) note_collision(l.place);
    made.friction = options_.collide && is_exact ? l.friction : 0.0;
    if (options_.collide && is_exact) made.collision_group = tree_of(i);
    finish_body(body, l.name, l.place, options_.collide && is_exact);
    mass_ += solid.mass;
    ++moving_;
  }

  /// The first link of the tree that a link belongs to: bodies of one tree do not collide.
  [[nodiscard]] int tree_of(std::size_t i) const {
    int tree = static_cast<int>(i);
    while (parent_root(index(tree)) >= 0) tree = parent_root(index(tree));
    return tree;
  }

  /// Finds whether the shapes of a body are one sphere or box about its centre of mass, along
  /// principal axes. Then sets the body's frame and moments to those of the shape.
  bool own_shape(std::size_t i, Pose& frame, Shape& shape, Vec3& moments) {
    std::vector<LinkShape> shapes;
    bool has_others = false;
    for (std::size_t j = i; j < model_.links.size(); ++j) {
      if (roots_[j] != static_cast<int>(i)) continue;
      has_others = has_others || model_.links[j].has_other_shapes;
      for (const LinkShape& own : model_.links[j].shapes) {
        shapes.push_back({own.solid, in_root_[j] * own.pose});
      }
    }
    if (shapes.empty() && !has_others) return false;
    constexpr double kSame = 1e-9;
    const MassProperties& solid = masses_[i];
    if (shapes.size() == 1 && !has_others) {
      const LinkShape& own = shapes.front();
      const bool centred =
          (own.pose.position - solid.centre).norm() <= kSame * own.solid.half.norm();
      if (centred && own.solid.kind == Solid::Kind::kSphere) {
        shape = Sphere{own.solid.half.x()};
        return true;
      }
      const Mat3 R = own.pose.orientation.toRotationMatrix();
      const Mat3 along = R.transpose() * solid.inertia * R;
      const Mat3 off = along - Mat3(along.diagonal().asDiagonal());
      if (centred && own.solid.kind == Solid::Kind::kBox &&
          off.cwiseAbs().maxCoeff() <= kSame * along.trace()) {
        shape = Box{own.solid.half};
        frame.orientation = own.pose.orientation;
        moments = along.diagonal();
        return true;
      }
    }
    report_.approximated.add(model_.links[i].place,
                             "a body is drawn as the box of its inertia and does not collide");
    return false;
  }

  /// What does not move is for the eye, and for collisions.
  void add_static(std::size_t i) {
    const Link& l = model_.links[i];
    const Pose& pose = in_root_[i];
    for (const LinkShape& own : l.shapes) {
      const bool is_sphere = own.solid.kind == Solid::Kind::kSphere;
      if (!is_sphere && own.solid.kind != Solid::Kind::kBox) continue;
      const Shape shape =
          is_sphere ? Shape(Sphere{own.solid.half.x()}) : Shape(Box{own.solid.half});
      add_fixed(shape, pose * own.pose, l, options_.collide);
      note_collision(l.place);
    }
    if (l.shapes.empty() && l.mass.mass > 0.0) {
      const PrincipalAxes axes = principal_axes(l.mass.inertia);
      add_fixed(Box{equivalent_box(l.mass.mass, axes.moments)},
                pose * Pose{l.mass.centre, axes.orientation}, l, false);
    }
  }
  void add_fixed(const Shape& shape, const Pose& pose, const Link& of, bool collides) {
    const Pose at = y_up(pose);
    const int i = builder_.add_fixed(shape, at.position);
    builder_.body(i).orientation = at.orientation;
    builder_.body(i).friction = of.friction;
    finish_body(i, of.name, of.place, collides);
  }

  void add_joints(std::size_t i) {
    if (bodies_[i] == kWorld) return;
    const Link& l = model_.links[i];
    const int parent = parent_root(i);
    if (parent >= 0 && bodies_[index(parent)] == kWorld) return;  // it has no mass: an error
    const int b = parent < 0 ? kWorld : bodies_[index(parent)];
    std::vector<PlacedJoint> placed = placed_[i];
    for (PlacedJoint& at : placed) {
      at.anchor = y_up(at.anchor);
      at.axis = y_up(at.axis);
    }
    if (placed.size() == 1) return add_joint(bodies_[i], b, placed.front());
    const std::size_t before = builder_.scene().joints.size();
    const MassProperties& solid = masses_[i];
    const double size = std::sqrt(solid.inertia.trace() / (2.0 * solid.mass));
    const std::string what = add_stack(builder_, {bodies_[i], b, size}, placed);
    if (what.empty()) {
      report_.errors.add(l.place, "body '" + l.name + "' has " + std::to_string(placed.size()) +
                                      " joints (" + kinds_of(l) +
                                      ") that no joint of a scene expresses");
      return;
    }
    for (std::size_t made = before; made < builder_.scene().joints.size(); ++made) {
      name_joint(static_cast<int>(made), l.joints.front());
    }
    ++stacks_["several joints that are " + what];
    for (const LinkJoint& joint : l.joints) note_lost_parts(joint, what);
  }

  static std::string kinds_of(const Link& l) {
    constexpr std::string_view kNames[] = {"hinge", "slide", "ball", "free"};
    std::string text;
    for (const LinkJoint& joint : l.joints) {
      text.append(text.empty() ? "" : ", ").append(kNames[static_cast<std::size_t>(joint.kind)]);
    }
    return text;
  }

  void name_joint(int i, const LinkJoint& joint) {
    builder_.joint(i).name = joint_names_.unique(joint.name);
    places_.joints.resize(static_cast<std::size_t>(i) + 1);
    places_.joints.back() = joint.place;
  }

  void add_joint(int a, int b, const PlacedJoint& at) {
    const LinkJoint& joint = *at.joint;
    if (joint.kind == JointKind::kFree) return note_lost_parts(joint, "a free body");
    if (joint.kind == JointKind::kBall) {
      name_joint(builder_.add_ball_joint(a, b, at.anchor), joint);
      ++stacks_["ball joints"];
      return note_lost_parts(joint, "a ball joint");
    }
    const bool is_hinge = joint.kind == JointKind::kHinge;
    const int i = is_hinge ? builder_.add_hinge(a, b, at.anchor, at.axis)
                           : builder_.add_prismatic(a, b, at.anchor, at.axis);
    name_joint(i, joint);
    ++stacks_[is_hinge ? "hinges" : "slides"];
    if (joint.limit) add_limit(i, joint, is_hinge);
    add_spring(i, joint);
    add_drive(i, joint);
    if (joint.friction > 0.0) builder_.rub(i, joint.friction);
    if (joint.armature > 0.0) builder_.add_armature(i, joint.armature);
  }

  void add_limit(int i, const LinkJoint& joint, bool is_hinge) {
    const double span = joint.limit->upper - joint.limit->lower;
    if (is_hinge && span >= 2.0 * std::numbers::pi) {
      report_.left_out.add(joint.place,
                           "a range of a full turn or more: the hinge turns without limits");
      return;
    }
    builder_.limit(i, joint.limit->lower - joint.start, joint.limit->upper - joint.start);
  }

  void add_spring(int i, const LinkJoint& joint) {
    if (joint.stiffness == 0.0 && joint.damping == 0.0) return;
    const double rest = joint.stiffness > 0.0 ? joint.rest - joint.start : 0.0;
    builder_.add_spring(i, {rest, joint.stiffness, joint.damping});
  }

  void add_drive(int i, const LinkJoint& joint) {
    if (!joint.drive || (joint.drive->stiffness == 0.0 && joint.drive->damping == 0.0)) return;
    Drive drive = *joint.drive;
    if (drive.stiffness > 0.0) drive.target -= joint.start;
    builder_.drive(i, drive);
  }

  /// Parts of a joint whose coordinate the scene does not have.
  void note_lost_parts(const LinkJoint& joint, const std::string& what) {
    std::string lost;
    const auto note = [&](bool is_given, const char* part) {
      if (is_given) lost.append(lost.empty() ? "" : ", ").append(part);
    };
    note(joint.limit.has_value(), "range");
    note(joint.stiffness > 0.0, "spring");
    note(joint.damping > 0.0, "damping");
    note(joint.friction > 0.0, "dry friction");
    note(joint.armature > 0.0, "armature");
    note(joint.drive.has_value(), "actuator");
    if (!lost.empty()) report_.left_out.add(joint.place, lost + " of a joint in " + what);
  }

  /// The pose of a frame of a link in its body, or in the world.
  [[nodiscard]] Pose in_body(int i, const Pose& own) const {
    if (i < 0) return y_up(own);
    const Pose in_root = in_root_[index(i)] * own;
    const int root = roots_[index(i)];
    return root < 0 ? y_up(in_root) : frames_[index(root)].inverse() * in_root;
  }
  [[nodiscard]] int body_of(int i) const {
    return i < 0 || roots_[index(i)] < 0 ? kWorld : bodies_[index(roots_[index(i)])];
  }

  void add_loop(const LinkLoop& loop) {
    int a = body_of(loop.a);
    int b = body_of(loop.b);
    Pose on_a = in_body(loop.a, loop.on_a);
    Pose on_b = in_body(loop.b, loop.on_b);
    if (a == kWorld) {
      std::swap(a, b);
      std::swap(on_a, on_b);
    }
    if (a == b) {
      report_.left_out.add(loop.place, "a constraint between two parts of one body");
      return;
    }
    const bool is_weld = loop.kind == LinkLoop::Kind::kWeld;
    const int i = is_weld ? builder_.add_weld(a, b, Vec3::Zero())
                          : builder_.add_ball_joint(a, b, Vec3::Zero());
    builder_.joint(i).anchor_a = on_a.position;
    builder_.joint(i).anchor_b = on_b.position;
    if (is_weld) {
      auto& weld = std::get<WeldJoint>(builder_.scene().joints[index(i)]);
      weld.axis_a = on_a.orientation * Vec3::UnitX();
      weld.axis_b = on_b.orientation * Vec3::UnitX();
      weld.across_a = on_a.orientation * Vec3::UnitY();
      weld.across_b = on_b.orientation * Vec3::UnitY();
    }
    LinkJoint named;
    named.name = loop.name;
    named.place = loop.place;
    name_joint(i, named);
  }

  void finish() {
    Scene& scene = builder_.scene();
    scene.name = identifier_of(model_.name);
    scene.title = text_within(model_.name.empty() ? scene.name : model_.name, kMaxTitle);
    scene.group = "imported";
    scene.description = "Imported from " + model_.source + ".";
    scene.gravity = y_up(model_.gravity);
    look_at_bodies(scene);
    report_.came_in.push_back("moving bodies: " + std::to_string(moving_) + ", " +
                              number_text(three_digits(mass_)) + " kg");
    if (parts_ > 0) {
      report_.came_in.push_back("merged into their parents, without joints: " +
                                std::to_string(parts_));
    }
    for (const auto& [what, count] : stacks_) {
      report_.came_in.push_back(what + ": " + std::to_string(count));
    }
    if (!model_.loops.empty()) {
      report_.came_in.push_back("loops: " + std::to_string(model_.loops.size()));
    }
  }

  static void look_at_bodies(Scene& scene) {
    Vec3 low = Vec3::Constant(1e9);
    Vec3 high = -low;
    for (const Body& body : scene.bodies) {
      if (body.is_static) continue;
      const Vec3 around = Vec3::Constant(radius_around(body.shape));
      low = low.cwiseMin(body.position - around);
      high = high.cwiseMax(body.position + around);
    }
    if ((low.array() > high.array()).any()) return;
    scene.camera.target = 0.5 * (low + high);
    scene.camera.eye = scene.camera.target + 2.0 * (high - low).norm() * Vec3(0.5, 0.3, 0.8);
  }

  Mechanism model_;
  const ImportOptions& options_;
  ImportReport& report_;
  ScenePlaces& places_;
  SceneBuilder builder_;
  UniqueNames body_names_{"world"};
  UniqueNames joint_names_;

  // Of every link.
  std::vector<int> roots_;              // the link with joints that it is a part of, or -1
  std::vector<Pose> in_root_;           // its pose in that link, or in the world
  std::vector<MassProperties> masses_;  // with its parts
  std::vector<char> joined_;            // its joints have become those of the next link
  std::vector<Motion> motions_;         // at the start
  std::vector<std::vector<PlacedJoint>> placed_;
  std::vector<int> bodies_;   // its body, or kWorld
  std::vector<Pose> frames_;  // of that body

  std::map<std::string, int> stacks_;
  double mass_ = 0.0;  // [kg]
  int moving_ = 0;
  int parts_ = 0;
};

}  // namespace

std::vector<Pose> reference_poses(const Mechanism& mechanism) {
  std::vector<Pose> poses;
  for (const Link& link : mechanism.links) {
    poses.push_back(link.parent < 0 ? link.pose : poses[index(link.parent)] * link.pose);
  }
  return poses;
}

Scene assemble(Mechanism mechanism, const ImportOptions& options, ImportReport& report,
               ScenePlaces& places) {
  return Assembly(std::move(mechanism), options, report, places).scene();
}

}  // namespace substep
