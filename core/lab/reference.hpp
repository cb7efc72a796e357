#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/budget.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// What a reference is worth.
struct ReferenceSummary {
  std::string source;         // "exact: ...", or "finest run: ..."
  double uncertainty = 0.0;   // of the positions [m]
  double window = 0.0;        // how long the motion can be foretold [s]
  double energy_scale = 0.0;  // 100 % of the energy drift [J], 0 where there is none
  std::string energy_scale_source;
};

/// The motion that errors are measured from: where the tracked body is after every frame.
struct Reference : ReferenceSummary {
  // Frame 0 is the start, world [m]; empty where the scene tracks nothing.
  std::vector<Vec3> track;
};

/// For runs whose errors are not needed.
const Reference& no_reference();

/// How long the motion of a scene can be foretold: contact makes it chaotic. [s]
double predictable_window(const Scene& scene, double duration);

/// Finds the reference of a scene frame by frame, so that a page stays alive meanwhile. In this
/// order: closed form (free flight; a box on a slope), minimal coordinates (chains on parallel
/// hinges; trees of hinges and ball joints in space), else the scene itself with the direct solver,
/// leapfrog and 256 sub-steps, its distance from 128 being the uncertainty.
class ReferenceRun {
 public:
  /// @param budget of a frame of the finest run
  ReferenceRun(std::shared_ptr<const Scene> scene, double duration, const Budget& budget = {});
  ~ReferenceRun();
  ReferenceRun(ReferenceRun&&) noexcept;
  ReferenceRun& operator=(ReferenceRun&&) noexcept;

  /// One more frame, or a part of it. @return false when all are done
  bool advance();
  [[nodiscard]] double progress() const;  ///< 0 to 1
  /// Valid once advance() has returned false.
  [[nodiscard]] const Reference& reference() const;

  /// Where a reference comes from; one class each, in reference.cpp.
  class Source;

 private:
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Source> source_;
  Reference reference_;
  std::int64_t frame_ = 0;
  std::int64_t frames_ = 0;
  double kinetic_ = 0.0;  // largest [J]
};

/// The whole reference at once.
Reference find_reference(const std::shared_ptr<const Scene>& scene, double duration);

}  // namespace substep
