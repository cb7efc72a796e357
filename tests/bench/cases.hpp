#pragma once
// The timed cases, the same natively and in WebAssembly: a scene and a solver at 16 sub-steps a
// frame, or at the number for alpha = 0.1, repeating the scene's first seconds.

#include <array>
#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/sim/simulator.hpp"

namespace substep::bench {

struct Case {
  const char* scene;
  SolverKind solver;
};

inline constexpr std::array kCases{
    Case{"swinging_box", SolverKind::kBpp}, Case{"swinging_box", SolverKind::kPgs},
    Case{"bridge", SolverKind::kBpp},       Case{"bridge", SolverKind::kPgs},
    Case{"heavy_stack", SolverKind::kBpp},  Case{"heavy_stack", SolverKind::kPgs},
};

/// "swinging_box/bpp", "bridge/pgs_25".
std::string name_of_case(const Case& c);

/// A case ready to step. Going back to the start costs a copy of the state, once in kFrames frames.
class Loop {
 public:
  static constexpr int kFrames = 300;

  /// A scene that cannot be read ends the program, with its problems on stderr.
  Loop(const std::string& folder, const Case& c, Mode mode);

  /// Disables energies, errors and stage times in reports: the cost of the motion alone.
  void leave_out_measures();

  /// One frame.
  FrameReport step();

  /// Allocations within all frames so far.
  [[nodiscard]] std::int64_t allocated() const { return allocated_; }

 private:
  Simulator simulator_;
  State start_;
  int frame_ = 0;
  std::int64_t allocated_ = 0;
};

}  // namespace substep::bench
