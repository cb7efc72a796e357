#include "core/model/state.hpp"

#include "core/math/hash.hpp"
#include "core/model/scene.hpp"

namespace substep {

State initial_state(const Scene& scene) {
  State state;
  for (const Body& body : scene.bodies) {
    state.x.push_back(body.position);
    state.q.push_back(body.orientation);
    state.u.push_back(velocity_of(body));
  }
  state.u_synchronised = state.u;
  if (scene.carried) static_cast<Carried&>(state) = *scene.carried;
  return state;
}

std::uint64_t state_hash(const State& state) {
  Hash hash;
  hash.add(state.time);
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    for (int j = 0; j < 3; ++j) hash.add(state.x[i][j]);
    for (int j = 0; j < 4; ++j) hash.add(state.q[i].coeffs()[j]);
    for (int j = 0; j < 6; ++j) hash.add(state.u[i][j]);
  }
  return hash.value();
}

}  // namespace substep
