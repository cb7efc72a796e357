#include "app/stiffness.hpp"

#include <algorithm>

namespace substep {

std::vector<StiffnessLeader> stiffness_by_body(const Scene& scene, const State& state) {
  std::vector<StiffnessLeader> list;
  if (state.k.size() != scene.bodies.size()) return list;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;
    StiffnessLeader most{static_cast<int>(i), 0, 0.0, body.mass, 0.0};
    for (int dof = 0; dof < 6; ++dof) {
      const double mass = dof < 3 ? body.mass : body.inertia[dof - 3];
      const double k = state.k[i][dof];
      if (k / mass > most.r) most = {static_cast<int>(i), dof, k, mass, k / mass};
    }
    list.push_back(most);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.r > b.r; });
  return list;
}

}  // namespace substep
