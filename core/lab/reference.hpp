#pragma once

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
};

/// For runs whose errors are not needed.
const Reference& no_reference();

/// Predictable time of a scene's motion [s]: the scene's own `window`; otherwise contact makes it
/// chaotic.
double predictable_window(const Scene& scene, double duration);

/// Computes the reference of a scene frame by frame, to keep a page responsive. In this order:
/// closed form (free flight; a box on a slope), minimal coordinates (chains on parallel hinges;
/// trees of hinges and ball joints in space), else the scene itself with the direct solver,
/// leapfrog and 256 sub-steps, its distance from 128 being the uncertainty.
class ReferenceRun {
 public:
  /// @param budget of a frame of the finest run
  ReferenceRun(std::shared_ptr<const Scene> scene, double duration, const Budget& budget = {});
  ~ReferenceRun();
  ReferenceRun(ReferenceRun&&) noexcept;
  ReferenceRun& operator=(ReferenceRun&&) noexcept;

  /// Computes one frame, or a part of it. @return false when done
  bool advance();
  [[nodiscard]] double progress() const;  ///< 0 to 1
  /// Valid once advance() has returned false.
  [[nodiscard]] const Reference& reference() const;

  /// Source of a reference; one class each, in reference.cpp.
  class Source;

 private:
  [[nodiscard]] double time_of(std::int64_t frame) const;  // at its end [s]

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Source> source_;
  Reference reference_;
  std::int64_t frame_ = 0;
  std::int64_t frames_ = 0;
  double kinetic_ = 0.0;  // largest [J]
};

/// The complete reference in one call.
Reference find_reference(const std::shared_ptr<const Scene>& scene, double duration);

}  // namespace substep
