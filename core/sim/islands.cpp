#include "core/sim/islands.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/forces/applied_forces.hpp"

namespace substep {

Islands::Islands(const Scene& scene)
    : speed_(scene.bodies.size()), way_(scene.bodies.size()), island_(scene.bodies.size()) {
  const std::size_t n = scene.bodies.size();
  connected_.reserve(n);
  bodies_.reserve(n);
  first_.reserve(n + 1);
  n_.reserve(n);
  levels_.reserve(n);
  constexpr std::size_t kUsualParts = 8;  // more are added on demand
  while (parts_.size() < kUsualParts) add_part(scene);
}

void Islands::add_part(const Scene& scene) {
  Part& part = parts_.emplace_back();
  part.bodies.reserve(scene.bodies.size());
  part.moving.reserve(scene.bodies.size());
  part.joints.reserve(scene.joints.size());
  part.has.reserve(scene.bodies.size());
}

void Islands::find(const Scene& scene, const Part& all, const State& state,
                   std::span<const Mat3> R_WB, double ahead, Detector* detector) {
  const auto moves = [&](int body) { return body >= 0 && !scene.bodies[index(body)].is_static; };
  connected_.reset(scene.bodies.size());
  if (scene.effects.joints) {
    for (const Joint& joint : scene.joints) {
      const JointBase& j = base(joint);
      if (moves(j.a) && moves(j.b)) connected_.unite(j.a, j.b);
    }
  }
  for (bool grown = detector != nullptr; grown;) {
    grown = false;
    set_ways(scene, state, ahead);
    for (const BroadPhase::Pair& pair : detector->within_reach(scene, all, state, R_WB, way_)) {
      if (moves(pair.i) && moves(pair.j) && connected_.unite(pair.i, pair.j)) grown = true;
    }
  }
  list(scene);
}

void Islands::set_ways(const Scene& scene, const State& state, double ahead) {
  std::fill(speed_.begin(), speed_.end(), 0.0);
  const auto n = static_cast<int>(island_.size());
  for (int i = 0; i < n; ++i) {
    double& fastest = speed_[index(connected_.root(i))];
    const Body& body = scene.bodies[index(i)];
    fastest = std::max(
        fastest, fastest_point(body, state.u[index(i)]) + ahead * acceleration_bound(scene, body));
  }
  for (int i = 0; i < n; ++i) {
    way_[index(i)] =
        scene.bodies[index(i)].is_static ? 0.0 : ahead * speed_[index(connected_.root(i))];
  }
}

void Islands::list(const Scene& scene) {
  first_.assign(1, 0);
  for (int i = 0; i < static_cast<int>(island_.size()); ++i) {
    const bool moves = !scene.bodies[index(i)].is_static;
    if (moves && connected_.root(i) == i) first_.push_back(0);
    // The root precedes all other bodies of its island.
    island_[index(i)] = !moves                    ? -1
                        : connected_.root(i) == i ? count() - 1
                                                  : island_[index(connected_.root(i))];
    if (moves) ++first_[index(island_[index(i)]) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  bodies_.resize(index(first_.back()));
  for (int i = static_cast<int>(island_.size()); i-- > 0;) {
    if (island_[index(i)] >= 0) bodies_[index(--first_[index(island_[index(i)]) + 1])] = i;
  }
  // Offsets are now shifted by one place.
  std::rotate(first_.begin(), first_.begin() + 1, first_.end());
  first_.back() = static_cast<int>(bodies_.size());
}

std::span<const int> Islands::bodies(int island) const {
  const int first = first_[index(island)];
  return std::span(bodies_).subspan(index(first), index(first_[index(island) + 1] - first));
}

void Islands::make_parts(const Scene& scene) {
  levels_.assign(n_.begin(), n_.end());
  std::sort(levels_.begin(), levels_.end(), std::greater<>());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  if (!levels_.empty() && levels_.back() == 0) levels_.pop_back();  // islands at rest
  while (parts_.size() < levels_.size()) add_part(scene);
  const auto n_of = [&](int body) { return n_[index(island_[index(body)])]; };
  const auto part_of = [&](int body) -> Part& {
    const int n = n_of(body);
    const auto level = std::lower_bound(levels_.begin(), levels_.end(), n, std::greater<>());
    return parts_[static_cast<std::size_t>(level - levels_.begin())];
  };
  for (Part& part : parts_) {
    part.bodies.clear();
    part.joints.clear();
    part.has.assign(scene.bodies.size(), 0);
    part.moving.clear();
  }
  const auto add = [](Part& part, int body) {
    part.bodies.push_back(body);
    part.has[index(body)] = 1;
  };
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    if (island_[index(i)] < 0) {
      for (Part& part : parts_) add(part, i);
      continue;
    }
    if (n_of(i) == 0) continue;
    Part& part = part_of(i);
    add(part, i);
    part.moving.push_back(i);
  }
  if (!scene.effects.joints) return;
  for (int i = 0; i < static_cast<int>(scene.joints.size()); ++i) {
    const int a = base(scene.joints[index(i)]).a;  // which moves
    if (n_of(a) > 0) part_of(a).joints.push_back(i);
  }
}

}  // namespace substep
