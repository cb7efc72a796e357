#pragma once

#include <vector>

#include "core/solver/pgs.hpp"
#include "core/solver/saddle_ldlt.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Block principal pivoting (Judice and Pires 1994) on a direct factorisation. The impulses of
/// active rows sit at their bounds, the others solve the linear system; every row on the wrong side
/// changes its set at once, for Settings::pivots steps; after that one row at a time (the last one,
/// Murty's rule), which cannot cycle but can take long: past a bound Gauss-Seidel takes over.
/// Friction bounds are fixed while it pivots, seeded with the impulses given, and refreshed
/// outside, at most four times.
///
/// A regularisation r that stands in for finite precision lets heavy loads sink: with
/// Settings::refinements it resists only how far impulses go from a centre, x0 = those of the last
/// sub-step, then those of the last solve,
///   w = J u+ + (softness - r) x + r (x - x0) + bias,
/// which is the proximal point method (Rockafellar 1976; for constrained bodies Carpentier et al.
/// 2021). Each is a solve with the factor as it is, unless rows change their sets.
class Bpp final : public Solver {
 public:
  void reserve(std::size_t bodies, std::size_t blocks) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;
  void find_impulses(std::span<Block> blocks) override;

 private:
  /// From the active set and the factor as they stand.
  void find_active_set(const System& system, const Settings& settings, SolveReport& report);
  void centre(const System& system);
  /// A row's new set.
  struct Move {
    std::size_t block = 0;
    int row = 0;
    std::int8_t set = 0;
  };
  void start_active_set(const System& system);
  void set_friction_bounds(const System& system, bool cone, bool first);
  /// Turns a contact's box towards what is against its sliding. @param first of the passes
  void turn_cone(const System& system, bool first, Block& block) const;
  /// True if the friction bounds that follow from the solution leave it a solution.
  [[nodiscard]] bool bounds_settled(const System& system, bool cone) const;
  void solve_active_set(const System& system, SolveReport& report);
  void solve_free(const System& system, SolveReport& report);  // whatever rows are free
  /// Moves rows on the wrong side to their right set. @param one_only only the last such row
  /// @return how many rows there were
  int pivot(const System& system, bool one_only);
  void move(std::span<Block> blocks, const Move& move);
  void change_factor(std::size_t block);
  /// Whether the impulses are a better start than none are.
  /// @param system u* on entry; overwritten
  [[nodiscard]] bool better_than_none(const System& system) const;
  /// Whether more work is done than allowed; the report says so.
  bool over_limits(const System& system, SolveReport& report) const;
  /// From the impulses as they stand, clamped to their bounds, or from none.
  void go_on_with_gauss_seidel(const System& system, const Settings& settings, SolveReport& report);

  SaddleLdlt ldlt_;
  Pgs gauss_seidel_;
  bool any_contact_ = false;
  bool factor_valid_ = false;           // the factor belongs to the present active set
  bool has_impulses_ = false;           // all: of Gauss-Seidel, or refined
  std::vector<double> friction_bound_;  // per block [N s]
  struct Centre {
    double row[kMaxRows];
  };
  std::vector<Centre> centre_;  // per block: of the regularisation [N s or N m s]
};

}  // namespace substep
