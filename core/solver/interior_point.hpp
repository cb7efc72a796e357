#pragma once

#include <span>
#include <vector>

#include "core/solver/saddle_ldlt.hpp"
#include "core/solver/system.hpp"

namespace substep {

/// Bounds of the impulse of a row [N s or N m s].
struct Bounds {
  double lo = 0.0;
  double hi = 0.0;
};

/// Mehrotra's predictor-corrector method (1992) for impulses between fixed bounds: it approaches
/// the minimum of
///   1/2 x^T A x + q^T x,   lo <= x <= hi,   A = J Mt^-1 J^T + softness,   q = J u* + bias,
/// from inside. Bounds are barriers, which only add to the softness and bias of their rows, so that
/// each iteration factors the system with all rows free. Redundant rows, and rows that neither push
/// nor separate, make pivoting cycle, but not this method: it took 10 to 25 iterations in piles of
/// 50 to 465 boxes. Every contact needs a softness: barriers vanish towards the solution and would
/// leave a singular system of redundant rigid rows.
class InteriorPoint {
 public:
  void reserve(std::size_t blocks) { rows_.reserve(3 * blocks); }  // contacts with friction

  /// Starts from the impulses of the blocks, moved inside the bounds.
  /// @param system its u is u*  @param bounds per block, kMaxRows each; read where Block::binds()
  void begin(const System& system, std::span<const Bounds> bounds, SaddleLdlt& ldlt);
  /// Iterates until the mean product of the distances from the bounds and the speeds that these
  /// cause is at most `end` of that at the beginning, and chooses the active set: a row is at a
  /// bound if its distance times `scale` is below that speed. Softness and bias are unchanged on
  /// return. May be called again with a smaller end.
  /// @return false if rounding or the number of iterations ended it earlier
  bool advance(const System& system, double end, SaddleLdlt& ldlt);
  /// Solves for the joints and the velocities with the impulses that have been reached.
  void settle(const System& system, SaddleLdlt& ldlt) const;

 private:
  /// A row with two different bounds.
  struct Row {
    std::size_t block = 0;
    int row = 0;
    double scale = 0.0;     // J Mt^-1 J^T + softness [1/kg or 1/(kg m^2)]
    double bias = 0.0;      // of the system
    double softness = 0.0;  // of the system
    double x = 0.0;         // impulse [N s or N m s]
    // Distances from the bounds, which can be too short for x to resolve [N s or N m s], and the
    // speeds that the bounds cause [m/s or rad/s]. All are positive. Without an upper bound `below`
    // is infinite and z_hi is 0.
    double above = 0.0;
    double below = 0.0;
    double z_lo = 0.0;
    double z_hi = 0.0;
    // Changes by the current solve.
    double dx = 0.0;
    double dz_lo = 0.0;
    double dz_hi = 0.0;
    // Products of the predicted changes of a distance and its speed [J].
    double bent_lo = 0.0;
    double bent_hi = 0.0;
  };
  /// @return false if a number is not finite; then no row has changed
  bool iterate(const System& system, SaddleLdlt& ldlt);
  /// Finds the changes towards products that equal the centre [J].
  void solve(const System& system, double centre, SaddleLdlt& ldlt);
  /// The part of the changes that stays inside all bounds, at most 1.
  [[nodiscard]] double longest_step() const;
  /// Of distances and speeds, after this part of the changes [J].
  [[nodiscard]] double mean_product(double part) const;
  void choose_sets(const System& system) const;

  std::vector<Row> rows_;
  double n_bounds_ = 0.0;
  double first_ = 0.0;  // mean product at the beginning [J]
  double mean_ = 0.0;   // the same now [J]
  int iterations_ = 0;
};

}  // namespace substep
