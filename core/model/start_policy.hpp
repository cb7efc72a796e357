#pragma once

#include <cstdint>

namespace substep {

/// Treatment of a start with poses or velocities inconsistent with the joints.
enum class StartPolicy : std::uint8_t {
  kProject,  // the smallest change of poses and velocities that satisfies the joints
  kKeep,     // unchanged; the drift correction removes the errors
  kRefuse,   // an error of the scene file
};

}  // namespace substep
