// Layout of the factor: nodes, couplings and kinds. Recomputed only when constraints are added or
// removed.

#include <algorithm>
#include <utility>

#include "core/solver/saddle_ldlt.hpp"

namespace substep {

namespace {

// A row is folded if 1/s exceeds its effective mass by at most this factor, which is the loss of
// precision in the inertia.
constexpr double kFold = 1e7;
constexpr int kLeafRows = 8;  // with more rows folding is cheaper
// A joint yields if the softness of a row exceeds this fraction of its mobility. In the articulated
// form, rounding errors of momenta grow by softness times inertia.
constexpr double kSofter = 1e-3;

/// Upper bound on J Mt^-1 J^T of a row on one body.
double mobility(const double (&J)[6], const InverseMass& mass) {
  return mass.linear * (J[0] * J[0] + J[1] * J[1] + J[2] * J[2]) +
         mass.angular.trace() * (J[3] * J[3] + J[4] * J[4] + J[5] * J[5]);
}

/// Upper bound on it of point rows, from the arms.
double point_mobility(const Block& joint, const System& system) {
  const auto most_of = [&](int body, const Vec3& r) {
    if (body < 0) return 0.0;
    const InverseMass& mass = system.inverse_mass[index(body)];
    return mass.linear + mass.angular.trace() * r.squaredNorm();
  };
  return most_of(joint.a, joint.r_a) + most_of(joint.b, joint.r_b);
}

}  // namespace

void SaddleLdlt::reserve(std::size_t bodies, std::size_t blocks) {
  constexpr std::size_t kCoupled = 4;  // typical of a body
  constexpr std::size_t kRows = 8;
  constexpr std::size_t kWidth = 6 * kCoupled;
  order_.reserve(bodies, blocks);
  bodies_ = 0;  // nodes point into memory that may move: forces a new layout
  keys_.reserve(blocks);
  nodes_.reserve(bodies);
  node_of_block_.reserve(blocks);
  attached_.reserve(blocks);
  coupled_.reserve(bodies * kCoupled);
  place_.reserve(bodies * kCoupled);
  first_filled_.reserve(bodies * kCoupled);
  children_.reserve(bodies);
  pushed_.reserve(bodies);
  rows_.reserve(blocks * kMaxRows);
  joints_.reserve(bodies);
  values_.reserve(bodies * (42 + 6 * kWidth + kRows * (7 + kRows + kWidth) + kWidth * kWidth));
  u_star_.reserve(bodies);
  w_.reserve(blocks * kMaxRows);
  v_.reserve(bodies);
  c_.reserve(blocks * kMaxRows);
  found_.reserve(blocks);
  u_begun_.reserve(bodies);
  u_earlier_.reserve(bodies);
}

bool SaddleLdlt::foldable(const Block& block, const System& system) const {
  int row = 0;
  if (block.has_point_rows) {  // bound for the first rows from the arms
    const double* s = block.softness;
    const double least = std::min(s[0], std::min(s[1], s[2]));
    if (!(point_mobility(block, system) <= kFold * least)) return false;
    row = 3;
  }
  for (; row < block.rows; ++row) {
    const double s = block.softness[row];
    if (s == 0.0) return false;
    double most = 0.0;
    if (block.a >= 0) most += mobility(block.J_a[row], system.inverse_mass[index(block.a)]);
    const auto& J_b = block.has_point_rows ? block.J_a : block.J_b;  // up to its sign
    if (block.b >= 0) most += mobility(J_b[row], system.inverse_mass[index(block.b)]);
    if (!(most <= kFold * s)) return false;
  }
  return true;
}

bool SaddleLdlt::yields(const Block& joint, const System& system) {
  const auto any_above = [&](int first, int end, double most) {
    return std::any_of(joint.softness + first, joint.softness + end,
                       [&](double softness) { return softness > most; });
  };
  if (!any_above(0, joint.rows, 0.0)) return false;
  const auto turning = [&](int body) {
    return body < 0 ? 0.0 : system.inverse_mass[index(body)].angular.trace();
  };
  return any_above(0, 3, kSofter * point_mobility(joint, system)) ||
         any_above(3, joint.rows, kSofter * (turning(joint.a) + turning(joint.b)));
}

bool SaddleLdlt::begin(const System& system) {
  flops_ = 0;
  factorisations_ = 0;
  factored_ = false;
  held_ = refined_ = false;
  softened_ = 0.0;
  inverse_mass_ = system.inverse_mass;
  u_star_.resize(system.u.size());
  copy(system.u, u_star_);
  if (!layout_is_the_same(system) && !lay_out(system)) {
    bodies_ = 0;  // forces a new layout
    nodes_.clear();
    pushed_.clear();
    return false;
  }
  w_.resize(system.blocks.size() * kMaxRows);
  for (Node& node : nodes_) node.dirty = true;
  read(system.blocks);
  return true;
}

// Starts at the root: a joint refers to its parent's pivot.
void SaddleLdlt::read(std::span<const Block> blocks) {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    for (std::size_t k = 0; k < node.n_attached; ++k) {
      const Attached& attached = attached_[node.first_attached + k];
      const Block& block = blocks[index(attached.block)];
      if (node.kind == NodeKind::kArticulated) {  // its only joint
        node.joint->read(block, attached.is_a, u_star_.data(), node.reference);
        continue;
      }
      double* w = w_.data() + index(attached.block) * kMaxRows;
      row_speeds(block, u_star_, w);
      for (int row = 0; row < block.rows; ++row) w[row] += block.bias[row];
    }
  }
}

bool SaddleLdlt::layout_is_the_same(const System& system) {
  const auto key_of = [](const Block& block) {
    return Key{block.a, block.b,
               4 * block.rows + (block.is_bounded() ? 2 : 0) + (block.has_point_rows ? 1 : 0)};
  };
  const auto has_key = [&](const Block& block, const Key& key) { return key_of(block) == key; };
  if (bodies_ != system.u.size() || !std::equal(system.blocks.begin(), system.blocks.end(),
                                                keys_.begin(), keys_.end(), has_key)) {
    bodies_ = system.u.size();
    keys_.clear();
    for (const Block& block : system.blocks) keys_.push_back(key_of(block));
    order_.update(system.blocks, bodies_, system.limits.memory);
    return false;
  }
  for (const Node& node : nodes_) {
    if (node.in_tree) {
      const Attached& joint = attached_[node.first_attached];
      if (joint.yields != yields(system.blocks[index(joint.block)], system)) return false;
    }
    if (node.kind != NodeKind::kGeneral) continue;
    for (std::size_t k = 0; k < node.n_attached; ++k) {
      const Attached& attached = attached_[node.first_attached + k];
      if (attached.foldable != foldable(system.blocks[index(attached.block)], system)) return false;
    }
  }
  return true;
}

bool SaddleLdlt::lay_out(const System& system) {
  needed_memory_ = order_.needed_memory();
  if (needed_memory_ > system.limits.memory) return false;
  nodes_.clear();
  coupled_.clear();
  for (const int body : order_.order()) {
    Node node;
    node.body = body;
    node.first_coupled = coupled_.size();
    for (const int other : order_.coupled(body)) coupled_.push_back(order_.position(other));
    node.coupled = static_cast<int>(coupled_.size() - node.first_coupled);
    if (node.coupled > 0) node.parent = coupled_[node.first_coupled];
    nodes_.push_back(node);
  }
  link_nodes();
  attach(system.blocks);
  any_folded_ = false;
  for (Node& node : nodes_) choose_kind(node, system);
  if (!make_room(system)) return false;
  link_articulated();
  return true;
}

void SaddleLdlt::place_lists(std::size_t Node::*first, std::size_t Node::*count) {
  std::size_t next = 0;
  for (Node& node : nodes_) {
    node.*first = next;
    next += std::exchange(node.*count, 0);
  }
}

void SaddleLdlt::link_nodes() {
  // A node's contribution goes to its first coupled body, whose coupled bodies include the others.
  place_.resize(coupled_.size());
  first_filled_.assign(coupled_.size(), 0);
  for (const Node& node : nodes_) {
    if (node.parent < 0) continue;
    Node& parent = nodes_[index(node.parent)];
    ++parent.n_children;
    const int* own = coupled_.data() + node.first_coupled;
    const int* others = coupled_.data() + parent.first_coupled;
    int at = 0;
    place_[node.first_coupled] = -1;
    for (int i = 1; i < node.coupled; ++i) {
      while (others[at] != own[i]) ++at;
      place_[node.first_coupled + index(i)] = at;
    }
  }
  children_.resize(nodes_.size());
  place_lists(&Node::first_child, &Node::n_children);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].parent < 0) continue;
    Node& parent = nodes_[index(nodes_[i].parent)];
    children_[parent.first_child + parent.n_children++] = static_cast<int>(i);
    parent.update_flops += update_flops(width(nodes_[i]));
  }
}

// Capacity doubles, so that contacts added one by one rarely allocate; old values are freed first,
// since they are not read again.
bool SaddleLdlt::make_room(const System& system) {
  std::size_t articulated = 0;
  std::size_t values = 0;
  std::size_t rows = 0;
  for (Node& node : nodes_) {
    if (node.kind == NodeKind::kArticulated) count(node);
    if (node.kind == NodeKind::kArticulated) ++articulated;
    const std::size_t w = index(width(node));
    const std::size_t r = index(node.most_rows);
    node.values = values;
    if (node.kind != NodeKind::kArticulated) values += 42 + 6 * w + r * (7 + r + w);
    node.update = values;
    if (node.kind == NodeKind::kGeneral) values += w * w;
    node.first_row = rows;
    rows += r;
  }
  needed_memory_ = static_cast<double>(values) * sizeof(double);
  if (needed_memory_ > system.limits.memory) return false;
  joints_.resize(articulated);
  if (values > values_.capacity()) {
    const double most = std::max(needed_memory_, system.limits.memory);
    const double doubled = 2.0 * needed_memory_;
    values_ = std::vector<double>();
    values_.reserve(static_cast<std::size_t>(std::min(doubled, most)) / sizeof(double));
  }
  values_.resize(values);
  rows_.resize(rows);
  c_.resize(rows);
  v_.resize(nodes_.size());
  return true;
}

// Links for momentum and velocity: between articulated nodes at the pivots, to and from other nodes
// at the centre.
void SaddleLdlt::link_articulated() {
  auto next = joints_.begin();
  for (Node& node : nodes_) {
    if (node.kind != NodeKind::kArticulated) continue;
    node.joint = &*next++;
    node.joint->rest();
  }
  for (Node& node : nodes_) {
    if (node.kind == NodeKind::kArticulated) {
      if (node.parent >= 0) {
        ArticulatedJoint* parent = nodes_[index(node.parent)].joint;
        double* at_centre = v_[index(node.parent)].data();
        node.reference = parent == nullptr ? nullptr : parent->pivot();
        node.handed_to = parent == nullptr ? at_centre : parent->momentum();
        node.parent_velocity = parent == nullptr ? at_centre : parent->velocity();
      }
      if (node.n_children != 1) continue;
      node.carried = nodes_[index(children_[node.first_child])].joint;
    } else {
      node.pushed = true;
      for (int s = 0; s < node.coupled; ++s) {
        nodes_[index(coupled_[node.first_coupled + index(s)])].pushed = true;
      }
    }
  }
  pushed_.clear();
  for (const Node& node : nodes_) {
    if (node.pushed) pushed_.push_back(static_cast<int>(position(node)));
  }
}

void SaddleLdlt::attach(std::span<const Block> blocks) {
  node_of_block_.resize(blocks.size());
  attached_.resize(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    const int a = block.a < 0 ? -1 : order_.position(block.a);
    const int b = block.b < 0 ? -1 : order_.position(block.b);
    node_of_block_[i] = a < 0 ? b : b < 0 ? a : std::min(a, b);
    ++nodes_[index(node_of_block_[i])].n_attached;
  }
  place_lists(&Node::first_attached, &Node::n_attached);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Node& node = nodes_[index(node_of_block_[i])];
    Attached attached;
    attached.block = static_cast<int>(i);
    attached.is_a = blocks[i].a == node.body;
    const int other = attached.is_a ? blocks[i].b : blocks[i].a;
    if (other >= 0) {
      const int* list = coupled_.data() + node.first_coupled;
      attached.other =
          static_cast<int>(std::find(list, list + node.coupled, order_.position(other)) - list);
    }
    attached_[node.first_attached + node.n_attached++] = attached;
  }
}

void SaddleLdlt::choose_kind(Node& node, const System& system) {
  const std::span<const Block> blocks = system.blocks;
  Attached* attached = attached_.data() + node.first_attached;
  const int* children = children_.data() + node.first_child;
  const bool carries_trees = std::all_of(children, children + node.n_children, [&](int child) {
    return nodes_[index(child)].coupled == 1;
  });
  node.in_tree = carries_trees && node.n_attached == 1 &&
                 ArticulatedJoint::handles(blocks[index(attached[0].block)]) &&
                 node.coupled == (attached[0].other < 0 ? 0 : 1);
  if (node.in_tree) attached[0].yields = yields(blocks[index(attached[0].block)], system);
  if (node.in_tree && !attached[0].yields && redundant_ != Redundant::kImpulses) {
    node.kind = NodeKind::kArticulated;
    const Block& joint = blocks[index(attached[0].block)];
    attached[0].exact = std::all_of(joint.softness, joint.softness + joint.rows,
                                    [](double softness) { return softness == 0.0; });
    return;
  }
  int rows = 0;
  for (std::size_t k = 0; k < node.n_attached; ++k) rows += blocks[index(attached[k].block)].rows;
  node.kind = node.n_children == 0 && rows <= kLeafRows ? NodeKind::kLeaf : NodeKind::kGeneral;
  for (std::size_t k = 0; k < node.n_attached; ++k) {
    const Block& block = blocks[index(attached[k].block)];
    attached[k].foldable = foldable(block, system);
    attached[k].folded = node.kind == NodeKind::kGeneral && attached[k].foldable;
    if (!attached[k].folded) node.most_rows += block.rows;
    node.folds = node.folds || attached[k].folded;
    node.has_bounds = node.has_bounds || block.is_bounded();
    any_folded_ = any_folded_ || attached[k].folded;
  }
}

}  // namespace substep
