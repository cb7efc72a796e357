#include "core/model/part.hpp"

#include <algorithm>
#include <iterator>
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
  std::copy_if(part.bodies.begin(), part.bodies.end(), std::back_inserter(part.moving),
               [&](int body) { return !scene.bodies[index(body)].is_static; });
  return part;
}

}  // namespace substep
