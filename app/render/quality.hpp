#pragma once

#include <cstddef>
#include <string_view>

#include "app/render/renderer.hpp"

namespace substep {

/// Whether what draws is a processor. @param renderer as OpenGL names it
bool is_software(std::string_view renderer);

/// The finest quality with which a processor that must draw so many bodies does not keep the window
/// waiting.
Quality finest_in_software(std::size_t bodies);

/// Chooses how finely a picture that moves is drawn, so that it moves at 30 frames a second where a
/// processor must draw it. It looks at the time that drawing takes and never touches the run.
class QualityGovernor {
 public:
  /// Once a frame. @param wall_dt since the last one [s]
  /// @param own of that time, what simulating took: coarser pictures would not save it [s]
  void observe(double wall_dt, double own);
  [[nodiscard]] Quality quality() const { return quality_; }

 private:
  Quality quality_ = Quality::kFine;
  bool tried_ = false;     // this quality was reached from a coarser one
  int seen_ = 0;           // frames of the window that is judged
  int slow_ = 0;           // of them
  double lost_ = 0.0;      // what those took [s]
  double steady_ = 0.0;    // since the quality changed [s]
  double patience_ = 8.0;  // before a finer one is tried again [s]
};

}  // namespace substep
