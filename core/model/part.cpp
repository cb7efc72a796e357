#include "core/model/part.hpp"

#include <algorithm>
#include <numeric>

#include "core/model/scene.hpp"

namespace substep {

Part whole(const Scene& scene) {
  Part part;
  part.bodies.resize(scene.bodies.size());
  part.joints.resize(scene.joints.size());
  std::iota(part.bodies.begin(), part.bodies.end(), 0);
  std::iota(part.joints.begin(), part.joints.end(), 0);
  part.has.assign(scene.bodies.size(), 1);
  part.moving = static_cast<int>(std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                               [](const Body& body) { return !body.is_static; }));
  return part;
}

}  // namespace substep
