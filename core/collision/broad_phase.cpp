#include "core/collision/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace substep {

namespace {

// Margin relative to a body's reach. A larger margin means fewer sweeps but more false pairs.
constexpr double kRoom = 0.25;

Vec3 half_extents(const Shape& shape, const Mat3& R) {
  return std::visit([&](const auto& s) -> Vec3 { return s.bounds(R); }, shape);
}

/// Whether |d| <= reach along every axis.
bool within(const Vec3& d, const Vec3& reach) {
  return std::abs(d.x()) <= reach.x() && std::abs(d.y()) <= reach.y() &&
         std::abs(d.z()) <= reach.z();
}

}  // namespace

BroadPhase::BroadPhase(const Scene& scene) {
  const std::size_t n = scene.bodies.size();
  jointed_.resize(n);
  reach_.resize(n);
  swept_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Body& body = scene.bodies[i];
    if (body.collides && !std::holds_alternative<Plane>(body.shape)) {
      solids_.push_back(static_cast<int>(i));
    }
  }
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    if (j.b == kWorld) continue;
    jointed_[index(std::min(j.a, j.b))].push_back(std::max(j.a, j.b));
  }
  for (auto& list : jointed_) std::sort(list.begin(), list.end());
  intervals_.reserve(solids_.size());
  pairs_.reserve(12 * n + 32);
}

bool BroadPhase::may_touch(const Scene& scene, int i, int j) const {
  const Body& a = scene.bodies[index(i)];
  const Body& b = scene.bodies[index(j)];
  if (a.is_static && b.is_static) return false;
  if (a.collision_group >= 0 && a.collision_group == b.collision_group) return false;
  const auto& joined = jointed_[index(std::min(i, j))];
  return joined.empty() || !std::binary_search(joined.begin(), joined.end(), std::max(i, j));
}

bool BroadPhase::overlap(const State& state, const Pair& pair) const {
  return within(state.x[index(pair.i)] - state.x[index(pair.j)],
                reach_[index(pair.i)] + reach_[index(pair.j)]);
}

bool BroadPhase::has_room(const Part& part, const State& state) const {
  return valid_ && std::all_of(solids_.begin(), solids_.end(), [&](int body) {
           if (!part.holds(body)) return true;
           const Swept& was = swept_[index(body)];
           const Vec3 left = Vec3::Constant(was.room) - (reach_[index(body)] - was.reach);
           return within(state.x[index(body)] - was.x, left);
         });
}

void BroadPhase::update(const Scene& scene, const Part& part, const State& state,
                        std::span<const Mat3> R_WB, std::span<const double> way) {
  const double margin = 0.5 * scene.contact.margin;
  for (const int body : solids_) {
    if (!part.holds(body)) continue;
    const double around = way.empty() ? margin : margin + way[index(body)];
    reach_[index(body)] =
        half_extents(scene.bodies[index(body)].shape, R_WB[index(body)]) + Vec3::Constant(around);
  }
  visits_ += 2 * std::ssize(solids_);
  if (!has_room(part, state)) sweep(scene, state);
}

void BroadPhase::sweep(const Scene& scene, const State& state) {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = -lo;
  for (const int body : solids_) {
    Swept& swept = swept_[index(body)];
    swept = {state.x[index(body)], reach_[index(body)], kRoom * reach_[index(body)].maxCoeff()};
    lo = lo.cwiseMin(swept.x);
    hi = hi.cwiseMax(swept.x);
  }
  Eigen::Index axis = 0;
  (hi - lo).maxCoeff(&axis);
  intervals_.clear();
  for (const int body : solids_) {
    const Swept& swept = swept_[index(body)];
    const double half = swept.reach[axis] + swept.room;
    intervals_.push_back({swept.x[axis] - half, swept.x[axis] + half, body});
  }
  // The order of ties is irrelevant: the pairs are sorted below.
  std::sort(intervals_.begin(), intervals_.end(),
            [](const Interval& p, const Interval& q) { return p.lo < q.lo; });
  visits_ += 2 * std::ssize(solids_);
  pairs_.clear();
  for (std::size_t p = 0; p < intervals_.size() && !too_many(); ++p) {
    const Swept& a = swept_[index(intervals_[p].body)];
    for (std::size_t q = p + 1; q < intervals_.size() && intervals_[q].lo <= intervals_[p].hi;
         ++q) {
      ++visits_;
      const Swept& b = swept_[index(intervals_[q].body)];
      if (!within(a.x - b.x, a.reach + b.reach + Vec3::Constant(a.room + b.room))) continue;
      const int i = std::min(intervals_[p].body, intervals_[q].body);
      const int j = std::max(intervals_[p].body, intervals_[q].body);
      if (may_touch(scene, i, j)) pairs_.push_back({i, j});
    }
  }
  valid_ = !too_many();
  if (!valid_) return;
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& p, const Pair& q) { return p.i != q.i ? p.i < q.i : p.j < q.j; });
}

}  // namespace substep
