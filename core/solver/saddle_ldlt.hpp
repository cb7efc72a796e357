#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/solver/articulated_joint.hpp"
#include "core/solver/cost_model.hpp"
#include "core/solver/dense_ldlt.hpp"
#include "core/solver/elimination_order.hpp"
#include "core/solver/spring.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Solves Eq. 3 for the change of velocity v = u+ - u*, eliminating body by body; J Mt^-1 J^T is
/// never formed.
///
///   [ Mt  -J^T ] [v]   [ J^T x_tight    ]       over the free rows;
///   [ J     s  ] [x] = [ -(J u* + bias) ]       the impulses of active rows are given
///
/// A node of the elimination is a body with all constraints to later bodies. It receives the
/// contributions of earlier nodes, and contributes a symmetric matrix (Schur complement) to the
/// later bodies it is coupled to. There are three kinds of nodes:
///  - articulated: one joint with point rows to one later body or the world, in closed form, which
///    loses digits to rows softer than the bodies: such a joint is not articulated;
///  - leaf: no contributions, so Mt^-1 is known and only the rows remain, S = s + J Mt^-1 J^T;
///  - general: LDL^T of the 6 x 6 inertia, then of S.
/// In a general node, rows with enough softness are folded into the bodies as springs of stiffness
/// 1/s, and x = -(J u + bias)/s follows from the velocities: any number of contact points costs no
/// more than one 6 x 6 block. Other rows, such as exact joints, are kept as pivots after their
/// body, to avoid dividing by a small s.
///
/// When rows become active or free, only their nodes and the ancestors of these are refactored.
class SaddleLdlt {
 public:
  /// What refine() finds where rows are redundant, so that their impulses are not unique.
  enum class Redundant : std::uint8_t {
    kVelocities,        // and some impulses
    kImpulsesOfCycles,  // those of least norm of the rows outside articulated nodes
    kImpulses           // those of least norm of all rows: no node is articulated
  };
  /// Of the mobility: the softness in refine() for impulses. Corrections converge more slowly than
  /// with less; singular poses do not matter, because the velocities are known.
  static constexpr double kShared = 1e-6;

  explicit SaddleLdlt(Redundant redundant = Redundant::kVelocities) : redundant_(redundant) {}
  SaddleLdlt(const SaddleLdlt&) = delete;
  SaddleLdlt& operator=(const SaddleLdlt&) = delete;

  void reserve(std::size_t bodies, std::size_t blocks);
  /// Starts a new system, with its u as u*. @return false if the factor would exceed the memory in
  /// System::limits; then solve() must not be called, and needed_memory() is the amount
  bool begin(const System& system);
  /// Memory of the factor's values [bytes].
  [[nodiscard]] double needed_memory() const { return needed_memory_; }
  /// Reads a new bias for the same rows; factors are kept.
  void read(std::span<const Block> blocks);
  /// Marks a block whose rows have become active or free.
  void touch(std::size_t block);
  /// Computes u+ and the impulses of free rows from those of active rows; refactors changed nodes.
  /// If that would exceed the work in System::limits, only flops(), a lower bound, is valid.
  void solve(const System& system);
  /// Computes the impulses that solve() skips because no velocity depends on them: those of
  /// articulated or folded joints. After refine() all are known.
  void find_impulses(std::span<Block> blocks);

  /// True if a pivot was clamped since `begin`: rows are redundant, and the solution is that of
  /// softer ones.
  [[nodiscard]] bool held() const { return held_; }
  /// Softens the rows outside articulated nodes, so that redundant ones share their impulses, and
  /// removes the softness by iterative refinement; all rows are free. May be called again with
  /// another bias.
  void refine(const System& system);

  /// Floating-point operations since `begin`.
  [[nodiscard]] std::int64_t flops() const { return flops_; }
  /// Solves since `begin` that changed the factor.
  [[nodiscard]] int factorisations() const { return factorisations_; }
  [[nodiscard]] std::span<const Vec6> u_star() const { return u_star_; }

 private:
  /// If a pivot is clamped, all rows of its node are softened by this share of their mobility, in
  /// refine() those of all nodes outside trees. It causes a relative error of the same size, and
  /// rounding errors of 1e-16 over it.
  static constexpr double kSoftened = 1e-9;
  enum class NodeKind : std::uint8_t { kArticulated, kLeaf, kGeneral };
  /// A constraint, stored at the node of its first-eliminated body.
  struct Attached {
    int block = 0;
    int other = -1;  // index among the node's coupled bodies, -1: static
    bool is_a = false;
    bool exact = false;  // articulated nodes: value at layout time
    bool foldable = false;
    bool folded = false;
    bool yields = false;  // see yields(); value at layout time, for nodes with in_tree
  };
  struct Node {
    int body = 0;
    NodeKind kind = NodeKind::kGeneral;
    bool in_tree = false;  // one joint with point rows, to one later body or the world
    bool dirty = true;
    int parent = -1;                // the node that receives this one's contribution
    int coupled = 0;                // later bodies
    std::size_t first_coupled = 0;  // into coupled_
    std::size_t first_child = 0;    // into children_
    std::size_t n_children = 0;
    std::size_t first_attached = 0;  // into attached_
    std::size_t n_attached = 0;
    std::size_t first_row = 0;  // into rows_ and c_
    int n_rows = 0;             // free and not folded
    int most_rows = 0;
    bool folds = false;  // some rows are folded
    bool has_bounds = false;
    bool gathered = false;  // its rows are gathered and fixed: none can become active
    FactorFlops springs;
    int counted_rows = -1;          // number of rows for which `flops` is valid
    std::int64_t update_flops = 0;  // to add the children's contributions
    FactorFlops flops;
    std::size_t values = 0;  // into values_, unless articulated
    std::size_t update = 0;  // into values_: contribution to the coupled bodies, general nodes only
    // Of an articulated node:
    ArticulatedJoint* joint = nullptr;          // one of joints_
    const ArticulatedJoint* carried = nullptr;  // joint of its single child, if that is articulated
    const double* reference = nullptr;          // of the parent: its pivot, nullptr for its centre
    double* handed_to = nullptr;                // momentum of the parent, nullptr for the world
    const double* parent_velocity = nullptr;    // at that reference point
    // Any node: itself, or an earlier node coupled to it, is not articulated: momentum at its
    // centre.
    bool pushed = false;
  };
  struct Row {
    const Attached* attached = nullptr;  // one of attached_
    int row = 0;
  };
  struct Key {  // what the layout depends on
    int a, b;
    int kind;  // number of rows, bounded and pin encoded in one number
    [[nodiscard]] int rows() const { return kind / 4; }
    friend bool operator==(const Key&, const Key&) = default;
  };
  /// The factor of a node, row-major.
  struct Factor {
    double* A;          // 6 x 6: L below the diagonal
    double* A_inverse;  // 6: 1/D
    double* Y;          // 6 x width: L^-1 B
    double* V;          // rows x 6: J L^-T; leaf: J Mt^-1
    double* S;          // rows x rows: L below the diagonal
    double* S_inverse;  // rows: 1/D
    double* Z;          // rows x width: L^-1 (J of the coupled bodies - J A^-1 B)
  };

  [[nodiscard]] static int width(const Node& node) { return 6 * node.coupled; }
  [[nodiscard]] Factor at(const Node& node) {
    const auto w = static_cast<std::size_t>(width(node));
    const auto r = static_cast<std::size_t>(node.most_rows);
    Factor f;
    f.A = values_.data() + node.values;
    f.A_inverse = f.A + 36;
    f.Y = f.A_inverse + 6;
    f.V = f.Y + 6 * w;
    f.S = f.V + 6 * r;
    f.S_inverse = f.S + r * r;
    f.Z = f.S_inverse + r;
    return f;
  }
  [[nodiscard]] std::size_t position(const Node& node) const {
    return static_cast<std::size_t>(&node - nodes_.data());
  }
  [[nodiscard]] bool foldable(const Block& block, const System& system) const;
  /// True if rows of a joint are softer than its bodies.
  [[nodiscard]] static bool yields(const Block& joint, const System& system);
  bool layout_is_the_same(const System& system);
  bool lay_out(const System& system);
  /// Makes room for a list per node, one after the other: counts become offsets.
  void place_lists(std::size_t Node::*first, std::size_t Node::*count);
  void link_nodes();
  bool make_room(const System& system);
  void attach(std::span<const Block> blocks);
  void link_articulated();
  void choose_kind(Node& node, const System& system);

  /// @return false if it would exceed the work limit
  bool factor_node(Node& node, const System& system);
  void count(Node& node) const;  // counts its operations
  void sum_carried(const Node& node, Square6& sum);
  /// Calls with the width of a node, as a compile-time size for the common cases in chains, bridges
  /// and stacks.
  static void with_known_width(const Node& node, const auto& call) {
    switch (node.coupled) {
      case 0:
        return call(Known<0>{});
      case 1:
        return call(Known<6>{});
      case 2:
        return call(Known<12>{});
      default:
        return call(width(node));
    }
  }
  void factor_leaf(Node& node, std::span<const Block> blocks);
  void factor_leaf(Node& node, std::span<const Block> blocks, auto rows, auto n);
  void factor_general(Node& node, std::span<const Block> blocks);
  void factor_general(Node& node, std::span<const Block> blocks, auto n);
  void gather_rows(Node& node, std::span<const Block> blocks);
  void add_inertia(const Node& node, Square6& A) const;
  /// @param B, U of the parent, n wide; used if there are coupled bodies besides the parent
  void add_left(const Node& child, Square6& A, double* B, double* U, int n);
  void eliminate_rows(Node& node, std::span<const Block> blocks);
  /// Factors the rows of a node. @param form computes S, Z and the minimum pivots
  void factor_rows(const Node& node, std::span<const Block> blocks, auto rows, const auto& form);
  /// Softens all rows of a node whose S is formed, and not yet factored.
  /// @param share of the mobility
  void soften(const Node& node, std::span<const Block> blocks, double share);
  [[nodiscard]] double mean_mobility(const Block& block, int row) const;

  void set_momenta(std::span<const Block> blocks);
  [[nodiscard]] Vec6* of_body(int body);
  void find_spring_impulses(std::span<Block> blocks, bool of_pins);
  void forward(const Node& node);
  /// @param weighted D^-1 L^-1 g, leaf: g
  void forward_rows(const Node& node, const Factor& f, auto rows, auto n, const double* weighted);
  void backward(const Node& node, std::span<Block> blocks);
  /// @param change in: L^-1 g, leaf: Mt^-1 g; out: including the impulses of the rows
  void backward_rows(const Node& node, const Factor& f, auto rows, auto n, std::span<Block> blocks,
                     double* change);

  /// Softens rows outside articulated nodes by this share of their mobility.
  void soften_all(double share);
  /// Adds corrections to the solution of the softened rows.
  void correct(const System& system);
  /// Those of articulated and folded joints, from the last solve.
  void find_skipped_impulses(std::span<Block> blocks);
  /// Sets u* to the velocity under the current impulses, and sets up the system for their
  /// correction. @return its largest |w| at zero correction [m/s, rad/s]
  double start_correction(const System& system);

  Redundant redundant_;
  EliminationOrder order_;
  std::size_t bodies_ = 0;
  std::vector<Key> keys_;
  std::vector<Node> nodes_;
  std::vector<int> node_of_block_;
  std::vector<Attached> attached_;
  std::vector<int> coupled_;  // nodes
  std::vector<int> place_;    // parallel to coupled_: index in the parent's, -1: the parent itself
  // Parallel to coupled_, leaf nodes: the rows of Z before this one are zero on that coupled body.
  std::vector<int> first_filled_;
  std::vector<int> children_;  // nodes
  std::vector<int> pushed_;    // nodes that receive momentum at their centre
  std::vector<Row> rows_;
  std::vector<ArticulatedJoint> joints_;  // nodes point to them
  bool any_folded_ = false;
  bool held_ = false;      // a pivot
  bool refined_ = false;   // by refine(), since `begin`
  double softened_ = 0.0;  // share of its mobility by which every row outside articulated nodes is
  std::vector<double> values_;
  std::int64_t flops_ = 0;
  int factorisations_ = 0;
  bool factored_ = false;  // for the current free rows
  double needed_memory_ = 0.0;

  std::span<const InverseMass> inverse_mass_;  // of the system passed to begin()
  std::vector<Vec6> u_star_;
  std::vector<double> w_;  // J u* + bias, kMaxRows per block
  std::vector<Vec6> v_;    // per node: momentum, then its remainder, then the velocity; only the
                           // velocity for articulated nodes that are not `pushed`
  std::vector<double> c_;  // per row of a node, from forward to backward

  // Of refine():
  struct RowValues {
    double bias[kMaxRows];     // of the system
    double impulse[kMaxRows];  // before the current correction
    double earlier[kMaxRows];  // before the previous correction
  };
  std::vector<RowValues> found_;  // per block
  std::vector<Vec6> u_begun_;     // u* of the system
  std::vector<Vec6> u_earlier_;   // u+ before the last correction
};

}  // namespace substep
