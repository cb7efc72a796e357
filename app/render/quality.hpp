#pragma once

#include <cstddef>
#include <string_view>

#include "app/render/renderer.hpp"

namespace substep {

/// Whether the renderer is software. @param renderer GL_RENDERER
bool is_software(std::string_view renderer);

/// The finest quality at which a software renderer keeps the window responsive with this many
/// bodies.
Quality finest_in_software(std::size_t bodies);

/// Chooses the quality of a moving picture so that a software renderer reaches 30 frames a second.
/// It observes the drawing time and never affects the run.
class QualityGovernor {
 public:
  explicit QualityGovernor(Quality start = Quality::kFine) : quality_(start) {}
  /// Call once per frame. @param wall_dt since the last call [s]
  /// @param own share of it spent on simulation, which coarser pictures would not save [s]
  void observe(double wall_dt, double own);
  [[nodiscard]] Quality quality() const { return quality_; }

 private:
  Quality quality_;
  bool tried_ = false;     // this quality was reached from a coarser one
  int seen_ = 0;           // frames in the current window
  int slow_ = 0;           // slow frames among them
  double lost_ = 0.0;      // their total time [s]
  double steady_ = 0.0;    // since the quality changed [s]
  double patience_ = 8.0;  // wait before a finer quality is tried again [s]
};

}  // namespace substep
