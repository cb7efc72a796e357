#include "core/collision/detector.hpp"

#include <algorithm>

namespace substep {

namespace {

Vec3 bounding_half_extents(const Shape& shape, const Mat3& R) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return Vec3::Constant(sphere->radius);
  if (const auto* box = std::get_if<Box>(&shape)) return R.cwiseAbs() * box->half_extents;
  return Vec3::Zero();
}

void touch_plane(const Placed& a, const Shape& shape, const Placed& plane, double margin,
                 ContactPoints& out) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    sphere_plane(a, *sphere, plane, margin, out);
  if (const auto* box = std::get_if<Box>(&shape)) box_plane(a, *box, plane, margin, out);
}

void touch_solids(const Placed& i, const Shape& shape_i, const Placed& j, const Shape& shape_j,
                  double margin, ContactPoints& out) {
  const auto* sphere_i = std::get_if<Sphere>(&shape_i);
  const auto* sphere_j = std::get_if<Sphere>(&shape_j);
  const auto* box_i = std::get_if<Box>(&shape_i);
  const auto* box_j = std::get_if<Box>(&shape_j);
  if (sphere_i != nullptr && sphere_j != nullptr) {
    sphere_sphere(i, *sphere_i, j, *sphere_j, margin, out);
  } else if (sphere_i != nullptr && box_j != nullptr) {
    sphere_box(i, *sphere_i, j, *box_j, margin, out);
  } else if (box_i != nullptr && sphere_j != nullptr) {
    sphere_box(j, *sphere_j, i, *box_i, margin, out);
  } else if (box_i != nullptr && box_j != nullptr) {
    box_box(i, *box_i, j, *box_j, margin, out);
  }
}

}  // namespace

Detector::Detector(const Scene& scene) {
  const std::size_t n = scene.bodies.size();
  jointed_.resize(n);
  reach_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Body& body = scene.bodies[i];
    if (!body.collides) continue;
    const bool is_plane = std::holds_alternative<Plane>(body.shape);
    (is_plane ? planes_ : solids_).push_back(static_cast<int>(i));
  }
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    if (j.b == kWorld) continue;
    jointed_[static_cast<std::size_t>(std::min(j.a, j.b))].push_back(std::max(j.a, j.b));
  }
  for (auto& list : jointed_) std::sort(list.begin(), list.end());
  intervals_.reserve(solids_.size());
  pairs_.reserve(8 * n + 32);
  points_.reserve(8 * n + 32);
}

bool Detector::may_touch(const Scene& scene, int i, int j) const {
  const Body& a = scene.bodies[static_cast<std::size_t>(i)];
  const Body& b = scene.bodies[static_cast<std::size_t>(j)];
  if (a.is_static && b.is_static) return false;
  if (a.collision_group >= 0 && a.collision_group == b.collision_group) return false;
  const auto& joined = jointed_[static_cast<std::size_t>(std::min(i, j))];
  return joined.empty() || !std::binary_search(joined.begin(), joined.end(), std::max(i, j));
}

std::span<const ContactPoint> Detector::detect(const Scene& scene, const State& state,
                                               std::span<const Mat3> R_WB) {
  points_.clear();
  pairs_.clear();
  intervals_.clear();
  const double margin = scene.contact.margin;
  const auto placed = [&](int body) {
    const auto k = static_cast<std::size_t>(body);
    return Placed{body, state.x[k], R_WB[k]};
  };

  // Sweep along x. Ties in the order do not matter: the pairs are sorted below.
  for (const int body : solids_) {
    const auto k = static_cast<std::size_t>(body);
    reach_[k] =
        bounding_half_extents(scene.bodies[k].shape, R_WB[k]) + Vec3::Constant(0.5 * margin);
    intervals_.push_back({state.x[k].x() - reach_[k].x(), state.x[k].x() + reach_[k].x(), body});
  }
  std::sort(intervals_.begin(), intervals_.end(), [](const Interval& p, const Interval& q) {
    return p.lo != q.lo ? p.lo < q.lo : p.body < q.body;
  });
  for (std::size_t p = 0; p < intervals_.size() && !too_many(); ++p) {
    for (std::size_t q = p + 1; q < intervals_.size() && intervals_[q].lo <= intervals_[p].hi;
         ++q) {
      const int i = std::min(intervals_[p].body, intervals_[q].body);
      const int j = std::max(intervals_[p].body, intervals_[q].body);
      const auto ki = static_cast<std::size_t>(i);
      const auto kj = static_cast<std::size_t>(j);
      const Vec3 d = (state.x[ki] - state.x[kj]).cwiseAbs();
      const Vec3 reach = reach_[ki] + reach_[kj];
      if (d.y() > reach.y() || d.z() > reach.z()) continue;
      if (may_touch(scene, i, j)) pairs_.push_back({i, j});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& p, const Pair& q) { return p.i != q.i ? p.i < q.i : p.j < q.j; });

  for (const int plane : planes_) {
    for (const int body : solids_) {
      if (too_many()) return points_;
      if (!may_touch(scene, body, plane)) continue;
      touch_plane(placed(body), scene.bodies[static_cast<std::size_t>(body)].shape, placed(plane),
                  margin, points_);
    }
  }
  for (const Pair& pair : pairs_) {
    if (too_many()) return points_;
    touch_solids(placed(pair.i), scene.bodies[static_cast<std::size_t>(pair.i)].shape,
                 placed(pair.j), scene.bodies[static_cast<std::size_t>(pair.j)].shape, margin,
                 points_);
  }
  return points_;
}

}  // namespace substep
