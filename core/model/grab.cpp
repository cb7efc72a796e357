#include "core/model/grab.hpp"

#include <vector>

#include "core/model/body_checks.hpp"
#include "core/model/scene.hpp"
#include "core/model/validate.hpp"

namespace substep {

double joined_mass(const Scene& scene, int body) {
  if (body_fault(scene.bodies, body) || !is_runnable(scene)) return 0.0;
  std::vector<bool> found(scene.bodies.size(), false);
  std::vector<int> open{body};
  found[index(body)] = true;
  double mass = 0.0;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    mass += scene.bodies[static_cast<std::size_t>(at)].mass;
    for (const Joint& joint : scene.joints) {
      const JointBase& j = base(joint);
      if (j.a != at && j.b != at) continue;
      if (is_fixed(scene, j.a) || is_fixed(scene, j.b)) continue;
      const int other = j.a == at ? j.b : j.a;
      if (found[index(other)]) continue;
      found[index(other)] = true;
      open.push_back(other);
    }
  }
  return mass;
}

}  // namespace substep
