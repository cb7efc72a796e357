#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/model/budget.hpp"
#include "core/sim/simulator.hpp"

namespace substep {

/// What happens in a scene, seen in one run of it with reference_settings(). Tells which errors can
/// be compared.
class Survey {
 public:
  /// @param duration of the run [s]  @param budget of each of its frames
  Survey(std::shared_ptr<const Scene> scene, double duration, const Budget& budget = {});

  /// Computes one frame, or a part of it. @return false when done
  bool advance();
  /// The moving body that gets farthest from its start, of equal ones the first. The path of this
  /// one is compared if the scene tracks none. Nothing if no body leaves its place.
  [[nodiscard]] std::optional<int> farthest() const { return farthest_; }
  /// Whether a contact was within its margin.
  [[nodiscard]] bool touches() const { return touches_; }

 private:
  std::shared_ptr<const Scene> scene_;
  Simulator simulator_;
  State start_;
  std::int64_t frames_ = 0;
  double distance_ = 0.0;  // of the farthest [m]
  std::optional<int> farthest_;
  bool touches_ = false;
};

}  // namespace substep
