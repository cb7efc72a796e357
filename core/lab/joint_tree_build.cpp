// Builds the trees of a scene's joints, and checks that the scene starts consistently.

#include <Eigen/LU>
#include <algorithm>

#include "core/forces/applied_forces.hpp"
#include "core/lab/joint_tree.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

// Gaps up to this are treated as rounding; the start of the motion may differ from the scene's by
// as much.
constexpr double kTreeClosed = 1e-10;     // relative to 1 m + the distance from the origin [-]
constexpr double kTreeConsistent = 1e-9;  // of velocities, relative to 1 + the largest [-]
constexpr double kTreeParallel = 1e-9;    // sine between the two axes of a hinge [-]
constexpr double kEqualMoments = 1e-12;   // of moments of inertia, relative [-]
constexpr double kTreeStretch = 1e-5;     // of its reach: a tree is exact for rigid joints only
// Condition number of the inertia about a ball joint. Its product with the rounding error is the
// noise of accelerations, which shortens the steps: 1e7 takes some 100 per frame, 1e9 10,000.
constexpr double kWorstCondition = 1e7;  // [-]
constexpr double kFastest = 1e5;         // the integrator takes a step per radian or two [rad/s]

bool has_equal_moments(const Body& body) {
  const double spread = body.inertia.maxCoeff() - body.inertia.minCoeff();
  return spread <= kEqualMoments * body.inertia.maxCoeff();
}

/// Features that no tree can describe, whatever the joints.
bool is_out_of_scope(const Scene& scene) {
  if (has_applied_forces(scene.effects, {&Effects::gravity})) return true;
  if (scene.effects.contact || scene.regularisation != 0.0) return true;
  Effects beside_armature = scene.effects;
  beside_armature.armature = false;
  if (acts_on_coordinates(beside_armature)) return true;
  if (!scene.joints.empty() && !scene.effects.joints) return true;
  // Without the gyroscopic torque the simulated motion is not that of rigid bodies.
  return !scene.effects.gyroscopic &&
         !std::all_of(scene.bodies.begin(), scene.bodies.end(),
                      [](const Body& body) { return body.is_static || has_equal_moments(body); });
}

}  // namespace

class JointTree::Builder {
 public:
  explicit Builder(const Scene& scene)
      : scene_(scene), used_(scene.joints.size(), false), joints_of_(scene.bodies.size() + 1) {
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      joints_of(base(scene.joints[j]).a).push_back(j);
      joints_of(base(scene.joints[j]).b).push_back(j);
    }
  }

  std::optional<JointTree> build() {
    tree_.node_of_.assign(scene_.bodies.size(), -1);
    for (const Body& body : scene_.bodies) {
      tree_.at_start_.emplace_back(body.position, body.orientation.normalized());
    }
    if (scene_.effects.gravity) tree_.gravity_ = scene_.gravity;
    tree_.world_.a = -tree_.gravity_;
    if (!grow_from(kWorld)) return std::nullopt;
    for (int root = heaviest_left(); root >= 0; root = heaviest_left()) {
      add_free(root);
      if (!grow_from(root)) return std::nullopt;
    }
    if (tree_.nodes_.empty()) return std::nullopt;
    start();
    if (!starts_as_the_scene() || !can_be_followed()) return std::nullopt;
    if (!(tree_.stretch() <= kTreeStretch * tree_.reach())) return std::nullopt;
    return std::move(tree_);
  }

 private:
  [[nodiscard]] const Body& body(int i) const { return scene_.bodies[index(i)]; }
  [[nodiscard]] bool is_fixed(int i) const { return substep::is_fixed(scene_, i); }
  /// Indices of the joints per body; the world and all static bodies share one list.
  std::vector<std::size_t>& joints_of(int i) {
    return is_fixed(i) ? joints_of_.back() : joints_of_[index(i)];
  }
  [[nodiscard]] bool is_reached(int i) const {
    return is_fixed(i) || tree_.node_of_[index(i)] >= 0;
  }
  [[nodiscard]] Vec3 at_start(int i, const Vec3& point) const {
    if (i == kWorld) return point;
    const auto& [position, orientation] = tree_.at_start_[index(i)];
    return position + orientation * point;
  }
  [[nodiscard]] Vec3 turned_at_start(int i, const Vec3& axis) const {
    return i == kWorld ? axis : tree_.at_start_[index(i)].second * axis;
  }

  /// Breadth-first search from a body, or from the world and static bodies. @return true if the
  /// result is a tree
  bool grow_from(int root) {
    std::vector<int> reached{root};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const auto is_here = [&, here = reached[next]](int i) {
        return here == kWorld ? is_fixed(i) : i == here;
      };
      for (const std::size_t j : joints_of(reached[next])) {
        if (used_[j]) continue;
        const JointBase& joint = base(scene_.joints[j]);
        used_[j] = true;
        const int parent = is_here(joint.a) ? joint.a : joint.b;
        const int child = is_here(joint.a) ? joint.b : joint.a;
        if (is_fixed(child) && is_fixed(parent)) continue;
        if (is_reached(child)) return false;  // a loop, or a second joint of the same bodies
        if (!add_jointed(scene_.joints[j], parent, child)) return false;
        reached.push_back(child);
      }
    }
    return true;
  }

  [[nodiscard]] int heaviest_left() const {
    int heaviest = -1;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const int candidate = static_cast<int>(i);
      if (is_reached(candidate)) continue;
      if (heaviest < 0 || body(candidate).mass > body(heaviest).mass) heaviest = candidate;
    }
    return heaviest;
  }

  Node& add(int child) {
    tree_.node_of_[index(child)] = static_cast<int>(tree_.nodes_.size());
    Node& node = tree_.nodes_.emplace_back();
    node.body = child;
    node.mass = body(child).mass;
    node.inertia = body(child).inertia;
    tree_.weight_ += node.mass * tree_.gravity_.norm();
    return node;
  }

  void add_free(int root) {
    add(root);
    tree_.degrees_ += 6;
  }

  bool add_jointed(const Joint& joint, int parent, int child) {
    const JointBase& j = base(joint);
    const bool a_is_child = j.a == child;
    const Vec3& on_child = a_is_child ? j.anchor_a : j.anchor_b;
    const Vec3& on_parent = a_is_child ? j.anchor_b : j.anchor_a;
    const Vec3 at = at_start(parent, on_parent);
    if (!((at_start(child, on_child) - at).norm() <= kTreeClosed * (1.0 + at.norm()))) return false;
    Node& node = add(child);
    node.r = -on_child;
    node.compliance = j.compliance;
    if (is_fixed(parent)) {
      node.l = at;
    } else {
      node.parent = tree_.node_of_[index(parent)];
      node.l = on_parent + tree_.nodes_[index(node.parent)].r;
      tree_.reach_ += node.l.norm();
    }
    tree_.reach_ += node.r.norm();
    return std::visit([&](const auto& own) { return set_kind(own, a_is_child, parent, node); },
                      joint);
  }

  // Unsupported joint type: the scene has no reference of this kind.
  template <class J>
  bool set_kind(const J&, bool, int, Node&) {
    return false;
  }

  bool set_kind(const BallJoint&, bool, int, Node& node) {
    node.kind = Kind::kBall;
    tree_.degrees_ += 3;
    return true;
  }

  bool set_kind(const HingeJoint& hinge, bool a_is_child, int parent, Node& node) {
    node.kind = Kind::kHinge;
    tree_.degrees_ += 1;
    node.axis = (a_is_child ? hinge.axis_a : hinge.axis_b).normalized();
    const Vec3 on_parent = (a_is_child ? hinge.axis_b : hinge.axis_a).normalized();
    const Vec3 apart =
        turned_at_start(node.body, node.axis).cross(turned_at_start(parent, on_parent));
    node.angular_compliance = hinge.angular_compliance;
    if (scene_.effects.armature) node.armature = hinge.armature.value_or(0.0);
    const Quat& own = tree_.at_start_[index(node.body)].second;
    node.at_start =
        is_fixed(parent) ? own : Quat(tree_.at_start_[index(parent)].second.conjugate() * own);
    return apart.norm() <= kTreeParallel;
  }

  /// Initial positions of all nodes, then velocities, from the bodies.
  void start() {
    Eigen::Index size = 0;
    for (Node& node : tree_.nodes_) {
      node.q = size;
      size += node.kind == Kind::kFree ? 7 : node.kind == Kind::kBall ? 4 : 2;
    }
    for (Node& node : tree_.nodes_) {
      node.u = size;
      size += node.kind == Kind::kFree ? 6 : node.kind == Kind::kBall ? 3 : 1;
    }
    tree_.motion_.resize(tree_.nodes_.size());
    tree_.y_.setZero(size);
    for (const Node& node : tree_.nodes_) start(node, tree_.y_);
    tree_.slope(tree_.y_, tree_.dy_);
  }

  void start(const Node& node, Vector& y) const {
    const Vec3& omega = body(node.body).angular_velocity;
    if (node.kind == Kind::kHinge) {
      const Vec3 before = node.parent == kWorld
                              ? Vec3(Vec3::Zero())
                              : body(tree_.nodes_[index(node.parent)].body).angular_velocity;
      y[node.q] = 1.0;
      y[node.u] = turned_at_start(node.body, node.axis).dot(omega - before);
      return;
    }
    const bool is_free = node.kind == Kind::kFree;
    if (is_free) {
      y.segment<3>(node.q) = body(node.body).position;
      y.segment<3>(node.u) = body(node.body).velocity;
    }
    const Quat& q = tree_.at_start_[index(node.body)].second;
    y.segment<4>(node.q + (is_free ? 3 : 0)) << q.w(), q.x(), q.y(), q.z();
    y.segment<3>(node.u + (is_free ? 3 : 0)) = omega;
  }

  /// True if the coordinates reproduce the state of the bodies, and all values are finite.
  [[nodiscard]] bool starts_as_the_scene() const {
    double fastest = 0.0;
    for (const Body& b : scene_.bodies) {
      if (!b.is_static) fastest = std::max({fastest, b.velocity.norm(), b.angular_velocity.norm()});
    }
    for (const Node& node : tree_.nodes_) {
      const Vec6 apart = tree_.velocity(node.body) - velocity_of(body(node.body));
      if (!(apart.norm() <= kTreeConsistent * (1.0 + fastest))) return false;
    }
    return tree_.dy_.allFinite();
  }

  [[nodiscard]] bool can_be_followed() const {
    for (std::size_t i = 0; i < tree_.nodes_.size(); ++i) {
      const Motion& m = tree_.motion_[i];
      if (!(m.omega.norm() <= kFastest)) return false;
      if (tree_.nodes_[i].kind != Kind::kBall) continue;
      const Mat3& A = m.inertia.A;
      // No less than the ratio of its largest to its smallest eigenvalue.
      if (!(A.trace() * A.inverse().trace() <= kWorstCondition)) return false;
    }
    return true;
  }

  const Scene& scene_;
  std::vector<bool> used_;                           // of Scene::joints
  std::vector<std::vector<std::size_t>> joints_of_;  // of Scene::bodies, then of the world
  JointTree tree_;
};

std::optional<JointTree> JointTree::of(const Scene& scene) {
  if (!is_runnable(scene)) return std::nullopt;
  if (is_out_of_scope(scene)) return std::nullopt;
  return Builder(scene).build();
}

}  // namespace substep
