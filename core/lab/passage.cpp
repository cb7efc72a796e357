#include "core/lab/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "core/collision/broad_phase.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr double kLeastDepth = 0.5;  // of the half width

// How deep a segment runs inside a shape, 0 if it stays outside or ends inside.

double depth_inside(const Sphere& sphere, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double t = std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const double r = sphere.radius;
  if (from.norm() < r || to.norm() < r) return 0.0;
  return std::max(0.0, r - (from + t * way).norm());
}

double depth_inside(const Box& box, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  double enters = 0.0;
  double leaves = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (way[i] == 0.0) {
      if (std::abs(from[i]) >= box.half_extents[i]) return 0.0;
      continue;
    }
    const double t = (-box.half_extents[i] - from[i]) / way[i];
    const double s = (box.half_extents[i] - from[i]) / way[i];
    enters = std::max(enters, std::min(t, s));
    leaves = std::min(leaves, std::max(t, s));
  }
  if (enters <= 0.0 || leaves >= 1.0 || enters >= leaves) return 0.0;
  // The distance to the nearest face is concave along the segment: the middle is deep enough
  // inside.
  const Vec3 middle = from + 0.5 * (enters + leaves) * way;
  return (box.half_extents - middle.cwiseAbs()).minCoeff();
}

double depth_inside(const Plane&, const Vec3&, const Vec3&) { return 0.0; }  // an overlap

}  // namespace

PassageWatch::PassageWatch(const Scene& scene, const State& start)
    : joined_(scene.bodies.size(), false),
      fast_(scene.bodies.size(), false),
      reach_(scene.bodies.size(), 0.0) {
  if (!is_runnable(scene) || !fits(start, scene)) return;
  collisions_ = std::make_shared<const BroadPhase>(scene);
  for (const Joint& joint : scene.joints) {
    joined_[index(base(joint).a)] = true;
    if (base(joint).b != kWorld) joined_[index(base(joint).b)] = true;
  }
  narrowest_ = std::numeric_limits<double>::infinity();
  for (const int i : collisions_->solids()) {
    narrowest_ = std::min(narrowest_, half_width(scene.bodies[index(i)].shape));
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    before_.push_back({start.x[i], start.q[i], start.u[i]});
  }
}

std::optional<Passage> PassageWatch::add(const Scene& scene, const State& now) {
  if (!collisions_ || !fits(now, scene)) return std::nullopt;
  const std::optional<Passage> found = first(scene, now);
  for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = {now.x[i], now.q[i], now.u[i]};
  return found;
}

std::optional<Passage> PassageWatch::first(const Scene& scene, const State& now) {
  const auto solids = collisions_->solids();
  double most_travel = 0.0;
  double most_reach = 0.0;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const int i : solids) {
    const Pose& was = before_[index(i)];
    const double rate = std::max(was.u.tail<3>().norm(), now.u[index(i)].tail<3>().norm());
    const double radius = radius_around(scene.bodies[index(i)].shape);
    const double travel = (now.x[index(i)] - was.x).norm() + rate * scene.frame * radius;
    fast_[index(i)] = travel >= kLeastDepth * narrowest_;
    reach_[index(i)] = travel + radius;
    most_travel = std::max(most_travel, travel);
    most_reach = std::max(most_reach, reach_[index(i)]);
    low = low.cwiseMin(now.x[index(i)]);
    high = high.cwiseMax(now.x[index(i)]);
  }
  if (!(most_travel >= kLeastDepth * narrowest_)) return std::nullopt;  // nearly always
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto at = [&](int i) { return now.x[index(i)][axis]; };
  sorted_.assign(solids.begin(), solids.end());
  std::sort(sorted_.begin(), sorted_.end(),
            [&](int i, int j) { return std::pair(at(i), i) < std::pair(at(j), j); });
  for (const int i : solids) {
    if (!fast_[index(i)]) continue;
    const double near = reach_[index(i)] + most_reach;
    auto next = std::lower_bound(sorted_.begin(), sorted_.end(), at(i) - near,
                                 [&](int j, double least) { return at(j) < least; });
    for (; next != sorted_.end() && at(*next) <= at(i) + near; ++next) {
      const int j = *next;
      const double both = reach_[index(i)] + reach_[index(j)];
      if ((now.x[index(i)] - now.x[index(j)]).squaredNorm() > both * both) continue;
      if (i == j || !collisions_->may_touch(scene, i, j)) continue;
      for (const auto& [body, through] : {std::pair{i, j}, std::pair{j, i}}) {
        if (const auto depth = depth_of_path(scene, now, body, through)) {
          return Passage{through, body, *depth};
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<double> PassageWatch::depth_of_path(const Scene& scene, const State& now, int body,
                                                  int through) const {
  const auto b = index(body);
  const auto t = index(through);
  const Pose& was = before_[b];
  const Pose& other = before_[t];
  const Vec3 from = other.q.conjugate() * (was.x - other.x);
  const Vec3 to = now.q[t].conjugate() * (now.x[b] - now.x[t]);
  const Shape& shape = scene.bodies[t].shape;
  const double depth = std::visit([&](const auto& s) { return depth_inside(s, from, to); }, shape);
  // An arc of the angle `turned` runs beside its chord, as does a path that joints bend.
  const double turned = scene.frame * std::max(other.u.tail<3>().norm(), now.u[t].tail<3>().norm());
  double aside = std::max(from.norm(), to.norm()) * turned * turned / 8.0;
  for (const auto i : {b, t}) {
    if (!joined_[i]) continue;
    aside += (now.u[i] - before_[i].u).head<3>().norm() * scene.frame / 8.0;
  }
  if (!(depth > std::max(aside, kLeastDepth * half_width(shape)))) return std::nullopt;
  return depth;
}

}  // namespace substep
