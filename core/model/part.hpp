#pragma once

#include <cstdint>
#include <vector>

namespace substep {

struct Scene;

/// The part of a scene that a sub-step moves: all of it, or islands that share a clock.
struct Part {
  std::vector<int> bodies;        // that move in it, and all static ones, ascending
  std::vector<int> joints;        // on those that move, ascending
  std::vector<std::uint8_t> has;  // per body of the scene: whether it is one of `bodies`
  std::vector<int> moving;        // those of them that move, ascending

  [[nodiscard]] bool holds(int body) const { return has[static_cast<std::size_t>(body)] != 0; }
};

Part whole(const Scene& scene);

}  // namespace substep
