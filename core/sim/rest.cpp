// Sleeping islands (setting `sleep`).

#include <algorithm>

#include "core/collision/contact_point.hpp"
#include "core/sim/simulator_impl.hpp"

namespace substep {

namespace {

// A body is at rest if all its points were slower than kRestSpeed for kRestTime.
constexpr double kRestSpeed = 0.04;  // half widths of its shape per second [1/s]
constexpr double kRestTime = 0.5;    // [s]

double half_width(const Body& body) {
  return std::visit([](const auto& shape) { return shape.half_width(); }, body.shape);
}

}  // namespace

bool Simulator::Impl::is_at_rest(std::span<const int> island) const {
  if (!settings.sleep || state.rest.empty()) return false;
  return std::all_of(island.begin(), island.end(), [&](int body) {
    const bool held = grab && grab->body == body;
    const bool driven = !current.motors_on.empty() && current.motors_on[index(body)].moves;
    return !held && !driven && state.rest[index(body)] > kRestTime - 0.5 * scene->frame;
  });
}

void Simulator::Impl::put_to_rest(std::span<const int> island) {
  for (const int body : island) {
    state.u[index(body)].setZero();
    state.u_synchronised[index(body)].setZero();
    for (auto* of_bodies : {&state.acceleration, &state.acceleration_change}) {
      if (!of_bodies->empty()) (*of_bodies)[index(body)].setZero();
    }
    for (auto* of_bodies : {&state.torque, &state.torque_change}) {
      if (!of_bodies->empty()) (*of_bodies)[index(body)].setZero();
    }
  }
}

// Sleeping bodies keep their forces for waking.
void Simulator::Impl::keep_forces_at_rest() {
  const auto sleeps = [&](int body) {
    return !scene->bodies[index(body)].is_static && !schedule.moves(body);
  };
  for (const StoredForce& force : state.forces) {
    if (is_contact_id(force.id)) {
      const auto [a, b] = bodies_of_contact(force.id);
      if (sleeps(a) || sleeps(b)) forces.push_back(force);
      continue;
    }
    const bool of_coordinate = CoordinateStage::is_id(force.id);
    const auto joint = of_coordinate ? index(CoordinateStage::joint_of(force.id))
                                     : static_cast<std::size_t>(force.id);
    if (joint < scene->joints.size() && sleeps(base(scene->joints[joint]).a)) {
      forces.push_back(force);
      const bool turns =
          of_coordinate && CoordinateStage::acts(force.id) == CoordinateStage::Acts::kArmature;
      if (turns) forces.back().elastic[0] = 0.0;  // it wakes at rest
    }
  }
}

void Simulator::Impl::time_rest() {
  if (!settings.sleep) return state.rest.clear();
  state.rest.resize(scene->bodies.size(), 0.0);
  for (std::size_t i = 0; i < state.rest.size(); ++i) {
    const Body& body = scene->bodies[i];
    const bool slow = fastest_point(body, state.u[i]) < kRestSpeed * half_width(body);
    state.rest[i] = slow ? std::min(state.rest[i] + scene->frame, kRestTime) : 0.0;
  }
}

}  // namespace substep
