#pragma once

#include <cstdint>

namespace substep {

/// What becomes of a start whose poses or velocities contradict the joints.
enum class StartPolicy : std::uint8_t {
  kProject,  // bodies are moved by the least change that closes the joints, velocities likewise
  kKeep,     // it is simulated as it stands; the drift correction takes the errors back
  kRefuse,   // it is an error of the scene file
};

}  // namespace substep
