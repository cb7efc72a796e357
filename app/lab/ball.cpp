#include "app/lab/ball.hpp"

#include <algorithm>

namespace substep {

Scene with_ball(const Scene& scene, const Ball& ball, std::size_t slot) {
  Scene out = scene;
  out.carried.reset();  // has no entry for the ball; with_ball(State) adds one
  if (!out.effects.contact) {
    out.effects.contact = true;
    for (Body& body : out.bodies) body.collision_group = 0;
  }
  Body body;
  body.name = "ball_" + std::to_string(slot);
  body.shape = Sphere{ball.radius};
  body.mass = ball.mass;
  body.inertia = solid_inertia(body.shape, body.mass);
  body.position = ball.position;
  body.velocity = ball.velocity;
  body.friction = 0.5;
  if (slot < out.bodies.size()) {
    out.bodies[slot] = body;
  } else {
    out.bodies.push_back(body);
  }
  return out;
}

State with_ball(State state, const Ball& ball, std::size_t slot) {
  const std::size_t size = std::max(state.x.size(), slot + 1);
  Vec6 u;
  u << ball.velocity, Vec3::Zero();
  const auto put = [&](auto& values, const auto& value) {
    values.resize(size, value);
    values[slot] = value;
  };
  put(state.x, ball.position);
  put(state.q, Quat::Identity());
  put(state.u, u);
  put(state.u_synchronised, u);
  if (!state.k.empty()) put(state.k, Vec6(Vec6::Zero()));
  if (!state.own.empty()) put(state.own, OwnSubstep{});
  if (!state.rotation.empty()) put(state.rotation, RatePeak{});
  if (!state.held.empty()) put(state.held, RatePeak{});
  if (!state.torque.empty()) put(state.torque, Vec3(Vec3::Zero()));
  if (!state.torque_change.empty()) put(state.torque_change, Vec3(Vec3::Zero()));
  if (!state.rest.empty()) put(state.rest, 0.0);
  if (!state.acceleration.empty()) put(state.acceleration, Vec6(Vec6::Zero()));
  if (!state.acceleration_change.empty()) put(state.acceleration_change, Vec6(Vec6::Zero()));
  if (!state.K_resisting.empty()) put(state.K_resisting, Mat3(Mat3::Zero()));
  return state;
}

}  // namespace substep
