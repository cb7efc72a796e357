#include "core/import/kinematic_tree.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

/// Which joints a tree prefers, the least first; nothing for those that carry no body.
std::optional<int> rank_of(const Joint& joint) {
  struct {
    std::optional<int> operator()(const UniversalJoint&) const { return 0; }
    std::optional<int> operator()(const PrismaticJoint&) const { return 0; }
    std::optional<int> operator()(const CylindricalJoint&) const { return 0; }
    std::optional<int> operator()(const HingeJoint& hinge) const {
      const bool has_parts = hinge.limit || hinge.motor || hinge.drive || hinge.spring ||
                             hinge.friction || hinge.armature;
      return has_parts ? 1 : 2;
    }
    std::optional<int> operator()(const BallJoint&) const { return 3; }
    std::optional<int> operator()(const WeldJoint&) const { return 4; }
    std::optional<int> operator()(const DistanceJoint&) const { return std::nullopt; }
    std::optional<int> operator()(const RopeJoint&) const { return std::nullopt; }
  } const rank;
  return std::visit(rank, joint);
}

/// Joints of the trees, by Kruskal's algorithm; the last node is the world.
class Forest {
 public:
  explicit Forest(const Scene& scene) : scene_(scene), root_(scene.bodies.size() + 1) {
    std::iota(root_.begin(), root_.end(), 0);
  }

  [[nodiscard]] std::size_t node(int body) const {
    return is_fixed(scene_, body) ? root_.size() - 1 : index(body);
  }
  /// Joins the trees of two bodies. @return false if they are one already
  bool join(int a, int b) {
    const std::size_t of_a = find(node(a));
    const std::size_t of_b = find(node(b));
    if (of_a == of_b) return false;
    root_[of_a] = of_b;
    return true;
  }

 private:
  std::size_t find(std::size_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }

  const Scene& scene_;
  std::vector<std::size_t> root_;
};

}  // namespace

KinematicTree KinematicTree::of(const Scene& scene) {
  KinematicTree tree;
  std::vector<std::pair<int, int>> ranked;  // rank, joint
  const int joints = scene.effects.joints ? static_cast<int>(scene.joints.size()) : 0;
  for (int j = 0; j < joints; ++j) {
    if (const std::optional<int> rank = rank_of(scene.joints[index(j)])) {
      ranked.emplace_back(*rank, j);
    } else {
      tree.closing.push_back(j);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  Forest forest(scene);
  std::vector<std::vector<int>> joints_at(scene.bodies.size() + 1);
  for (const auto& [rank, j] : ranked) {
    const JointBase& of = base(scene.joints[index(j)]);
    if (forest.join(of.a, of.b)) {
      joints_at[forest.node(of.a)].push_back(j);
      joints_at[forest.node(of.b)].push_back(j);
    } else {
      tree.closing.push_back(j);
    }
  }
  std::sort(tree.closing.begin(), tree.closing.end());

  std::vector<char> placed(scene.bodies.size(), 0);
  std::vector<Node> open;  // a stack, because a rope may have thousands of links
  const auto add_children = [&](int body, int depth) {
    auto& at = joints_at[forest.node(body)];
    std::sort(at.begin(), at.end(), std::greater<>());  // the first is on top
    for (const int j : at) {
      const JointBase& of = base(scene.joints[index(j)]);
      const int child = forest.node(of.a) == forest.node(body) ? of.b : of.a;
      if (!is_fixed(scene, child) && placed[index(child)] == 0) {
        open.push_back({child, is_fixed(scene, body) ? kWorld : body, j, depth + 1});
      }
    }
  };
  const auto place_all = [&] {
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      placed[index(node.body)] = 1;
      tree.nodes.push_back(node);
      add_children(node.body, node.depth);
    }
  };
  add_children(kWorld, 0);
  place_all();
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
    if (is_fixed(scene, body) || placed[index(body)] != 0) continue;
    open.push_back({body, kWorld, -1, 1});
    place_all();
  }
  return tree;
}

}  // namespace substep
