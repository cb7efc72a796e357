#include "app/lab/stiffness.hpp"

#include <algorithm>

namespace substep {

StiffnessLeader stiffest_of(const Scene& scene, const State& state, std::size_t body) {
  const Body& b = scene.bodies[body];
  StiffnessLeader most{static_cast<int>(body), 0, 0.0, b.mass, 0.0};
  for (int dof = 0; dof < 6; ++dof) {
    const double mass = dof < 3 ? b.mass : b.inertia[dof - 3];
    const double k = state.k[body][dof];
    if (k / mass > most.r) most = {static_cast<int>(body), dof, k, mass, k / mass};
  }
  return most;
}

std::vector<StiffnessLeader> stiffness_by_body(const Scene& scene, const State& state) {
  std::vector<StiffnessLeader> list;
  if (state.k.size() != scene.bodies.size()) return list;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].is_static) list.push_back(stiffest_of(scene, state, i));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.r > b.r; });
  return list;
}

std::vector<double> stiffness_shares(const Scene& scene, const State& state) {
  const std::vector<StiffnessLeader> list = stiffness_by_body(scene, state);
  if (list.empty() || !(list.front().r > 0.0)) return {};
  std::vector<double> shares(scene.bodies.size(), 0.0);
  for (const StiffnessLeader& body : list) {
    shares[static_cast<std::size_t>(body.body)] = body.r / list.front().r;
  }
  return shares;
}

}  // namespace substep
