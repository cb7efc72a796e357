#pragma once

#include <cstdint>
#include <vector>

namespace substep {

struct Scene;

/// The part of a scene that a sub-step moves: the whole scene, or islands that share a clock.
struct Part {
  std::vector<int> bodies;        // moving bodies of the part and all static ones, ascending
  std::vector<int> joints;        // joints on the moving bodies, ascending
  std::vector<std::uint8_t> has;  // per body of the scene: true if it is in `bodies`
  std::vector<int> moving;        // the moving ones of `bodies`, ascending

  [[nodiscard]] bool holds(int body) const { return has[static_cast<std::size_t>(body)] != 0; }
};

Part whole(const Scene& scene);

}  // namespace substep
