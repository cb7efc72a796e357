#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/budget.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Source and accuracy of a reference.
struct ReferenceSummary {
  std::string source;         // "exact: ...", or "finest run: ..."
  double uncertainty = 0.0;   // of the positions [m]
  double window = 0.0;        // predictable time of the motion [s]
  double energy_scale = 0.0;  // 100 % of the energy drift [J], 0 if undefined
  std::string energy_scale_source;
};

/// The reference motion for errors: position of the tracked body after every frame.
struct Reference : ReferenceSummary {
  // Frame 0 is the start, world [m]; empty if the scene tracks no body.
  std::vector<Vec3> track;
  std::string failure;  // verdict of the run that it is, "fails at 0.4 s: ..."; "" if it holds
};

/// For runs whose errors are not needed.
const Reference& no_reference();

/// Predictable time of a scene's motion [s]: the scene's own `window`; otherwise contact makes it
/// chaotic.
double predictable_window(const Scene& scene, double duration);

/// Settings of a run that is a reference: the scene's own with the direct solver, leapfrog and
/// constant N.
Settings reference_settings(const Scene& scene, int n);

/// Computes the reference of a scene frame by frame, to keep a page responsive. In this order:
/// closed form (free flight; a box on a slope), minimal coordinates (chains on parallel hinges;
/// trees of hinges and ball joints in space), else the scene itself with the direct solver,
/// leapfrog and 256 sub-steps, its distance from 128 being the uncertainty.
///
/// If it is then less certain than required, the number of sub-steps is doubled, again and again,
/// and the distance from the run before is the uncertainty. The most certain run is the reference:
/// after many impacts that need not be the finest. It ends after two runs that were no more certain
/// than an earlier one, as in chaotic motion.
class ReferenceRun {
 public:
  static constexpr int kMostSubsteps = 4096;  // per frame, of a refined run
  static constexpr double kMostWork = 1e11;   // of all its runs [operations of the solver]
  static constexpr int kMostInVain = 2;       // refined runs in a row that are no more certain

  /// @param budget of a frame of the finest run
  /// @param required uncertainty up to which a run of the scene is refined [m]; none: not refined
  ReferenceRun(std::shared_ptr<const Scene> scene, double duration, const Budget& budget = {},
               double required = std::numeric_limits<double>::infinity());
  ~ReferenceRun();
  ReferenceRun(ReferenceRun&&) noexcept;
  ReferenceRun& operator=(ReferenceRun&&) noexcept;

  /// Computes one frame, or a part of it. @return false when done
  bool advance();
  [[nodiscard]] double progress() const;  ///< 0 to 1, of the current run
  /// "exact: ...", or "finest run: ...", of the current run.
  [[nodiscard]] std::string source() const;
  /// Valid once advance() has returned false.
  [[nodiscard]] const Reference& reference() const;

  /// Source of a reference; one class each, in reference.cpp.
  class Source;

 private:
  [[nodiscard]] double time_of(std::int64_t frame) const;  // at its end [s]
  void start();
  void complete();

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Source> source_;
  double required_;                // [m]
  Reference reference_;            // of the current run
  std::optional<Reference> best_;  // of the completed ones
  int in_vain_ = 0;                // runs since the best one
  bool done_ = false;
  std::int64_t frame_ = 0;
  std::int64_t frames_ = 0;
  double kinetic_ = 0.0;  // largest [J]
};

/// The complete reference in one call.
Reference find_reference(const std::shared_ptr<const Scene>& scene, double duration);

}  // namespace substep
