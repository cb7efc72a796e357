#include "core/sim/changed_scene.hpp"

#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/collision/contact_point.hpp"
#include "core/constraints/coordinate_stage.hpp"
#include "core/model/validate.hpp"
#include "core/stepping/stiffness_bound.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {
namespace {

/// Index by name; names that occur twice, and empty ones, have none.
template <class Items, class Name>
std::unordered_map<std::string_view, int> index_by_name(const Items& items, Name&& name_of) {
  std::unordered_map<std::string_view, int> found;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto [entry, is_new] = found.emplace(name_of(items[i]), static_cast<int>(i));
    if (!is_new) entry->second = -1;
  }
  found[""] = -1;
  return found;
}

int find(const std::unordered_map<std::string_view, int>& by_name, std::string_view name) {
  const auto found = by_name.find(name);
  return found == by_name.end() ? -1 : found->second;
}

/// Whether the entries are -1 or different indices of items before.
bool is_selection(const std::vector<int>& kept, std::size_t count, std::size_t before) {
  if (kept.size() != count) return false;
  std::vector<char> taken(before);
  for (const int i : kept) {
    if (i < -1 || i >= static_cast<int>(before)) return false;
    if (i >= 0 && std::exchange(taken[index(i)], 1)) return false;
  }
  return true;
}

/// The new indices of the items before, or -1.
std::vector<int> inverse(const std::vector<int>& kept, std::size_t before) {
  std::vector<int> out(before, -1);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] >= 0) out[index(kept[i])] = static_cast<int>(i);
  }
  return out;
}

bool same_pose(const Body& a, const Body& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}

/// The carried state of a run under new indices.
class Renumbering {
 public:
  Renumbering(const Scene& changed, const Scene& before, const State& state, const Kept& kept)
      : changed_(changed),
        before_(before),
        state_(state),
        kept_(kept),
        new_body_(inverse(kept.bodies, before.bodies.size())),
        new_joint_(inverse(kept.joints, before.joints.size())),
        starts_(changed.bodies.size()) {
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      starts_[i] = kept.bodies[i] < 0 || !same_pose(changed.bodies[i], body_before(i)) ||
                   velocity_of(changed.bodies[i]) != velocity_of(body_before(i));
    }
    for (std::size_t i = 0; i < changed.joints.size(); ++i) {
      if (kept.joints[i] < 0) start(base(changed.joints[i]).a, base(changed.joints[i]).b);
    }
    for (std::size_t i = 0; i < before.joints.size(); ++i) {
      const JointBase& joint = base(before.joints[i]);
      const auto now = [&](int body) { return body < 0 ? -1 : new_body_[index(body)]; };
      if (new_joint_[i] < 0) start(now(joint.a), now(joint.b));
    }
  }

  /// Sets where and how fast each body is.
  void place(std::vector<Body>& bodies) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (kept_.bodies[i] < 0 || bodies[i].is_static) continue;
      const std::size_t was = index(kept_.bodies[i]);
      const bool stays = same_pose(bodies[i], before_.bodies[was]);
      const bool goes_on = velocity_of(bodies[i]) == velocity_of(before_.bodies[was]);
      if (stays) {
        bodies[i].position = state_.x[was];
        bodies[i].orientation = state_.q[was];
      }
      if (goes_on) {
        bodies[i].velocity = state_.u_synchronised[was].head<3>();
        bodies[i].angular_velocity = state_.u_synchronised[was].tail<3>();
      }
    }
  }

  /// @param bodies after place()
  [[nodiscard]] Carried carried(const std::vector<Body>& bodies) const {
    Carried out;
    out.dt_previous = state_.dt_previous;
    out.r = state_.r;
    out.rotation_age = state_.rotation_age;
    out.held_frames = state_.held_frames;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      out.u.push_back(starts_[i] || bodies[i].is_static ? velocity_of(bodies[i])
                                                        : state_.u[index(kept_.bodies[i])]);
    }
    const Vec6 zero = Vec6::Zero();
    const Vec3 none = Vec3::Zero();
    out.k = of_bodies(state_.k, zero);
    out.K_resisting = of_bodies(state_.K_resisting, Mat3(Mat3::Zero()));
    out.acceleration = of_motion(state_.acceleration, zero);
    out.acceleration_change = of_motion(state_.acceleration_change, zero);
    out.torque = of_motion(state_.torque, none);
    out.torque_change = of_motion(state_.torque_change, none);
    out.rotation = of_bodies(state_.rotation, RatePeak{});
    out.held = of_bodies(state_.held, RatePeak{});
    out.rest.assign(state_.rest.empty() ? 0 : bodies.size(), 0.0);  // all wake
    for (std::size_t i = 0; i < bodies.size(); ++i) out.own.push_back(own(i));
    for (const StoredForce& force : state_.forces) {
      if (const auto id = id_of(force.id)) out.forces.emplace_back(force).id = *id;
    }
    // A probe finds the stiffness of what is new, and changes the forces of all. Islands find it in
    // their first frame.
    out.stiffness_known =
        state_.stiffness_known && (looks_for_islands(changed_.settings) || !starts_any());
    return out;
  }

 private:
  [[nodiscard]] const Body& body_before(std::size_t i) const {
    return before_.bodies[index(kept_.bodies[i])];
  }
  void start(int a, int b) {
    for (const int body : {a, b}) {
      if (body >= 0) starts_[index(body)] = 1;
    }
  }
  [[nodiscard]] bool starts_any() const {
    for (const char starts : starts_) {
      if (starts) return true;
    }
    return false;
  }

  template <class T>
  std::vector<T> of_bodies(const std::vector<T>& before, const T& of_new) const {
    std::vector<T> out;
    if (before.empty()) return out;
    for (const int was : kept_.bodies) out.push_back(was < 0 ? of_new : before[index(was)]);
    return out;
  }
  /// As of_bodies(), with the initial value for bodies that restart.
  template <class T>
  std::vector<T> of_motion(const std::vector<T>& before, const T& at_start) const {
    std::vector<T> out = of_bodies(before, at_start);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (starts_[i]) out[i] = at_start;
    }
    return out;
  }

  [[nodiscard]] OwnSubstep own(std::size_t i) const {
    if (kept_.bodies[i] < 0) return {};
    const int was = kept_.bodies[i];
    double r = state_.r;
    if (!state_.own.empty()) {
      r = state_.own[index(was)].r;
    } else if (!state_.k.empty()) {
      r = StiffnessStage::bound(before_, {&was, 1}, state_.k).r;
    }
    return {starts_[i] ? 0.0 : state_.dt_previous_of(index(was)), r};
  }

  [[nodiscard]] bool keeps_shape(int before, int now) const {
    return before_.bodies[index(before)].shape.index() == changed_.bodies[index(now)].shape.index();
  }

  /// The id of a constraint's force under the new indices, if it is kept.
  [[nodiscard]] std::optional<std::uint64_t> id_of(std::uint64_t id) const {
    if (is_contact_id(id)) {
      const auto [a, b] = bodies_of_contact(id);
      if (index(a) >= new_body_.size() || index(b) >= new_body_.size()) return std::nullopt;
      const int new_a = new_body_[index(a)];
      const int new_b = new_body_[index(b)];
      // The features of a pair are those of the shapes of its first and its second body.
      if (new_a < 0 || new_b < 0 || (a < b) != (new_a < new_b)) return std::nullopt;
      if (!keeps_shape(a, new_a) || !keeps_shape(b, new_b)) return std::nullopt;
      return contact_id(new_a, new_b, feature_of_contact(id));
    }
    const bool of_coordinate = CoordinateStage::is_id(id);
    const std::uint64_t joint =
        of_coordinate ? static_cast<std::uint64_t>(CoordinateStage::joint_of(id)) : id;
    if (joint >= new_joint_.size()) return std::nullopt;  // a grab
    const int now = new_joint_[static_cast<std::size_t>(joint)];
    if (now < 0) return std::nullopt;
    return of_coordinate ? CoordinateStage::id_of(index(now), CoordinateStage::acts(id))
                         : static_cast<std::uint64_t>(now);
  }

  const Scene& changed_;
  const Scene& before_;
  const State& state_;
  const Kept& kept_;
  std::vector<int> new_body_;   // per body before
  std::vector<int> new_joint_;  // per joint before
  std::vector<char> starts_;    // per body: it restarts
};

}  // namespace

Kept kept_by_name(const Scene& before, const Scene& changed) {
  Kept kept;
  const auto name_of_body = [](const Body& body) -> std::string_view { return body.name; };
  const auto bodies = index_by_name(before.bodies, name_of_body);
  const auto bodies_now = index_by_name(changed.bodies, name_of_body);
  for (const Body& body : changed.bodies) {
    const bool unique = find(bodies_now, body.name) >= 0;
    kept.bodies.push_back(unique ? find(bodies, body.name) : -1);
  }
  const auto name_of_joint = [](const Joint& joint) -> std::string_view {
    return base(joint).name;
  };
  const auto joints = index_by_name(before.joints, name_of_joint);
  const auto joints_now = index_by_name(changed.joints, name_of_joint);
  const auto same_body = [&](int now, int then) {
    if (now == kWorld || then == kWorld) return now == then;
    const bool exists = now >= 0 && index(now) < kept.bodies.size();  // else the scene is refused
    return exists && kept.bodies[index(now)] == then;
  };
  for (const Joint& joint : changed.joints) {
    const JointBase& now = base(joint);
    int was = find(joints_now, now.name) >= 0 ? find(joints, now.name) : -1;
    if (was >= 0) {
      const Joint& old = before.joints[index(was)];
      const JointBase& then = base(old);
      const bool same = old.index() == joint.index() && same_body(now.a, then.a) &&
                        same_body(now.b, then.b) && then.anchor_a == now.anchor_a &&
                        then.anchor_b == now.anchor_b;
      if (!same) was = -1;
    }
    kept.joints.push_back(was);
  }
  return kept;
}

Scene continue_with(Scene changed, const Scene& before, const State& state, const Kept& kept) {
  changed.carried.reset();
  if (!is_runnable(changed) || !is_runnable(before) || !fits(state, before) ||
      !is_selection(kept.bodies, changed.bodies.size(), before.bodies.size()) ||
      !is_selection(kept.joints, changed.joints.size(), before.joints.size())) {
    return {};
  }
  if (state.frame == 0) return changed;
  const Renumbering renumbering(changed, before, state, kept);
  std::vector<Body> bodies = changed.bodies;
  renumbering.place(bodies);
  changed.carried = renumbering.carried(bodies);
  changed.bodies = std::move(bodies);
  return changed;
}

}  // namespace substep
