#include "core/model/state_checks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "core/model/body_checks.hpp"
#include "core/model/number_checks.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr int kLeastSide = -1;  // of StoredForce::active_set
constexpr int kMostSide = 2;    // not known yet

/// Checks lists that have an item for every body.
class Lists {
 public:
  Lists(std::string pointer, std::size_t bodies, Problems& problems)
      : pointer_(std::move(pointer)), bodies_(bodies), problems_(problems) {}

  template <class Item>
  void required(const char* key, const std::vector<Item>& items) {
    if (sized(key, items)) finite(key, items);
  }
  template <class Item>
  void optional(const char* key, const std::vector<Item>& items) {
    if (!items.empty()) required(key, items);
  }
  template <class Item>
  bool sized(const char* key, const std::vector<Item>& items) {
    if (items.size() == bodies_) return true;
    problems_.push_back(
        {pointer_to(pointer_, key), "must have " + std::to_string(bodies_) +
                                        " items, one for each body of the scene, not " +
                                        std::to_string(items.size())});
    return false;
  }
  /// Reports only the first item that is not finite.
  template <class Item>
  void finite(const char* key, const std::vector<Item>& items) {
    const auto bad =
        std::find_if(items.begin(), items.end(), [](const Item& item) { return !finite(item); });
    if (bad == items.end()) return;
    problems_.push_back(
        {pointer_to(pointer_to(pointer_, key), static_cast<std::size_t>(bad - items.begin())),
         "must be finite"});
  }

 private:
  static bool finite(double item) { return std::isfinite(item); }
  static bool finite(const OwnSubstep& item) {
    return std::isfinite(item.dt_previous) && item.dt_previous >= 0.0 && std::isfinite(item.r) &&
           item.r >= 0.0;
  }
  static bool finite(const RotationPeak& item) {
    return std::isfinite(item.before) && item.before >= 0.0 && std::isfinite(item.now) &&
           item.now >= 0.0;
  }
  static bool finite(const auto& item) { return item.allFinite(); }

  std::string pointer_;
  std::size_t bodies_;
  Problems& problems_;
};

bool has_sound_numbers(const StoredForce& force) {
  const auto finite = [](double x) { return std::isfinite(x); };
  const auto side = [](std::int8_t tight) { return kLeastSide <= tight && tight <= kMostSide; };
  return std::all_of(std::begin(force.lambda), std::end(force.lambda), finite) &&
         std::all_of(std::begin(force.rate), std::end(force.rate), finite) &&
         std::isfinite(force.rate_age) && force.rate_age >= 0.0 &&
         std::all_of(std::begin(force.rate_change), std::end(force.rate_change), finite) &&
         std::all_of(std::begin(force.elastic), std::end(force.elastic), finite) &&
         std::all_of(std::begin(force.active_set), std::end(force.active_set), side);
}

}  // namespace

std::optional<std::string> body_fault(int body, const Scene& scene) {
  if (body >= 0 && index(body) < scene.bodies.size()) return std::nullopt;
  if (scene.bodies.empty()) return "the scene has no bodies";
  return must_be("the index of a body, from 0 to " + std::to_string(scene.bodies.size() - 1),
                 std::to_string(body));
}

void check_carried(const Carried& carried, const Scene& scene, const std::string& pointer,
                   Problems& problems) {
  check_number(carried.dt_previous, not_negative(1.0, "s"), pointer_to(pointer, "dt_previous"),
               problems);
  check_number(carried.r, not_negative(std::numeric_limits<double>::max(), "1/s^2"),
               pointer_to(pointer, "r"), problems);
  check_number(carried.rotation_age, not_negative(10.0, "s"), pointer_to(pointer, "rotation_age"),
               problems);
  Lists lists(pointer, scene.bodies.size(), problems);
  lists.required("u", carried.u);
  lists.optional("k", carried.k);
  lists.optional("k_resisting", carried.K_resisting);
  lists.optional("acceleration", carried.acceleration);
  lists.optional("acceleration_change", carried.acceleration_change);
  lists.optional("torque", carried.torque);
  lists.optional("torque_change", carried.torque_change);
  lists.optional("own", carried.own);
  lists.optional("rotation", carried.rotation);
  lists.optional("rest", carried.rest);
  if (carried.k.empty() && !carried.K_resisting.empty()) {
    problems.push_back({pointer_to(pointer, "k_resisting"), "requires k"});
  }
  const std::string forces = pointer_to(pointer, "forces");
  if (carried.forces.size() > kMaxForces) {
    problems.push_back({forces, too_many(carried.forces.size(), kMaxForces, "items")});
    return;
  }
  const auto bad =
      std::find_if_not(carried.forces.begin(), carried.forces.end(), has_sound_numbers);
  if (bad == carried.forces.end()) return;
  problems.push_back({pointer_to(forces, static_cast<std::size_t>(bad - carried.forces.begin())),
                      "must have finite numbers, and tight from -1 to 2"});
}

void check_state(const State& state, const Scene& scene, Problems& problems) {
  const std::string pointer = "/state";
  check_carried(state, scene, pointer, problems);
  Lists lists(pointer, scene.bodies.size(), problems);
  lists.required("x", state.x);
  lists.required("u_synchronised", state.u_synchronised);
  if (lists.sized("q", state.q)) {
    for (std::size_t i = 0; i < state.q.size(); ++i) {
      const auto fault = orientation_fault(state.q[i]);
      if (!fault) continue;
      problems.push_back({pointer_to(pointer_to(pointer, "q"), i), *fault});
      break;
    }
  }
  if (state.frame < 0) {
    problems.push_back(
        {pointer_to(pointer, "frame"), must_be("at least 0", std::to_string(state.frame))});
  }
  constexpr Range kTime = not_negative(std::numeric_limits<double>::max(), "s");
  check_number(state.time, kTime, pointer_to(pointer, "time"), problems);
}

void check_grab(const Grab& grab, const Scene& scene, Problems& problems) {
  if (auto fault = body_fault(grab.body, scene)) {
    problems.push_back({"/grab/body", std::move(*fault)});
  } else if (scene.bodies[index(grab.body)].is_static) {
    problems.push_back({"/grab/body", "must be a moving body, not a static one"});
  }
  if (!grab.anchor.allFinite()) problems.push_back({"/grab/anchor", "must be finite"});
  if (!grab.target.allFinite()) problems.push_back({"/grab/target", "must be finite"});
  if (!(grab.mass > 0.0) || !std::isfinite(grab.mass)) {
    problems.push_back({"/grab/mass", must_be("above 0 and finite (kg)", number_text(grab.mass))});
  }
}

}  // namespace substep
