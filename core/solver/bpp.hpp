#pragma once

#include <vector>

#include "core/solver/interior_point.hpp"
#include "core/solver/least_impulses.hpp"
#include "core/solver/pgs.hpp"
#include "core/solver/saddle_ldlt.hpp"
#include "core/solver/solver.hpp"

namespace substep {

/// Block principal pivoting (Judice and Pires 1994) on a direct factorisation. Active rows have
/// their impulses at a bound; free rows solve the linear system. All infeasible rows change sets at
/// once, for Settings::pivots steps. In piles most rows are redundant and the sets may cycle: if
/// all contacts yield a little, an interior-point method follows; else one row at a time changes
/// sets (the last, Murty's rule), which cannot cycle but can be slow. Beyond the limits of both
/// Gauss-Seidel takes over. Friction bounds are fixed meanwhile, initialised from the seed
/// impulses, and refreshed at most four times in an outer loop.
///
/// A numerical regularisation r lets heavy loads sink. With Settings::refinements it acts only on
/// the deviation from a centre x0, the impulses of the last sub-step, then of the last solve,
///   w = J u+ + (softness - r) x + r (x - x0) + bias,
/// which is the proximal point method (Rockafellar 1976; for constrained bodies Carpentier et al.
/// 2021). Each refinement reuses the factor, unless rows change sets.
class Bpp final : public Solver {
 public:
  /// @param redundant the impulses of redundant rows
  explicit Bpp(SaddleLdlt::Redundant redundant = SaddleLdlt::Redundant::kImpulses)
      : least_(redundant) {}
  void reserve(std::size_t bodies, std::size_t blocks, bool loops) override;
  SolveReport find_velocities(const System& system, const Settings& settings) override;
  /// Where contacts yield, or without any, the factor is used again, and bounds of friction are
  /// refreshed at most once.
  SolveReport find_velocities_again(const System& system, const Settings& settings,
                                    bool keeps_bounds) override;
  std::int64_t find_impulses(std::span<Block> blocks) override;

 private:
  /// The same for rows whose tangents are aligned and whose bias contains the centre.
  SolveReport find_again(const System& system, const Settings& settings);
  /// Starts from the current active set and factor, and refreshes the friction bounds before each
  /// pass.
  void find_active_set(const System& system, const Settings& settings, int passes,
                       SolveReport& report);
  /// For the bounds as they are. False beyond the limits of all methods, or of the work.
  /// @param single_pivots left  @param approached out: by the interior-point method
  bool find_within_bounds(const System& system, const Settings& settings, int& single_pivots,
                          bool& approached, SolveReport& report);
  void centre(const System& system);
  void solve_redundant(const System& system);
  /// Keeps u+ for find_impulses() if rows may be redundant.
  void keep_redundant(const System& system);
  /// A row's new set.
  struct Move {
    std::size_t block = 0;
    int row = 0;
    std::int8_t set = 0;
  };
  void start_active_set(const System& system);
  void set_friction_bounds(const System& system);
  void soften_sliding(const System& system);
  /// True if the solution stays valid under the friction bounds it implies.
  [[nodiscard]] bool bounds_settled(const System& system) const;
  void solve_active_set(const System& system);
  /// Moves infeasible rows to the correct set. @param one_only only the last such row @return
  /// number of infeasible rows
  int pivot(const System& system, bool one_only);
  void move(std::span<Block> blocks, const Move& move);
  // Each returns true if no row is infeasible; else look at the status.
  /// Moves all infeasible rows, at most so many times, and in a row without progress.
  bool pivot_blocks(const System& system, int most, int without_progress, SolveReport& report);
  /// Moves the last infeasible row. @param left times
  bool pivot_singly(const System& system, int& left, SolveReport& report);
  /// Finds the impulses from inside their bounds. Not for rigid contacts: barriers that vanish
  /// leave a singular system of their redundant rows.
  bool approach(const System& system, SolveReport& report);
  /// Tolerances on the complementarity of a row, w [m/s], and on its bounds [N s].
  [[nodiscard]] double speed_tolerance(const System& system, const Block& contact, int row) const;
  [[nodiscard]] double impulse_tolerance(const System& system, const Block& contact, int row) const;
  /// True if the current impulses are a better initial guess than zero.
  /// @param system u* on entry; overwritten
  [[nodiscard]] bool better_than_none(const System& system) const;
  /// True if the work limit is exceeded; sets the report's status.
  bool over_limits(const System& system, SolveReport& report) const;
  /// Starts from the current impulses clamped to their bounds, or from zero.
  void go_on_with_gauss_seidel(const System& system, const Settings& settings, SolveReport& report);

  SaddleLdlt ldlt_;
  LeastImpulses least_;
  System redundant_;  // the system last solved, if it may have redundant rows; else no blocks
  std::vector<Vec6> found_;  // its u+
  Pgs gauss_seidel_;
  InteriorPoint interior_point_;
  std::vector<Bounds> bounds_;  // per block, kMaxRows each
  bool any_bounded_ = false;
  bool has_impulses_ = false;           // all impulses are known, from Gauss-Seidel or refinement
  std::vector<double> friction_bound_;  // per block [N s]
  struct RowValues {
    double row[kMaxRows];
  };
  std::vector<RowValues> centre_;  // per block: centre of the regularisation [N s or N m s]
  std::vector<RowValues>
      unmet_;  // per block: w of redundant rows that no impulse makes 0 [m/s, rad/s]
};

}  // namespace substep
