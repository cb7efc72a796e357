#include "core/collision/detector.hpp"

#include <algorithm>
#include <iterator>

namespace substep {

namespace {

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

Detector::Detector(const Scene& scene) : broad_phase_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    radius_.push_back(radius_around(body.shape));
    if (!body.collides || !std::holds_alternative<Plane>(body.shape)) continue;
    Ground ground{static_cast<int>(i), {}};
    for (const int solid : broad_phase_.solids()) {
      if (broad_phase_.may_touch(scene, solid, ground.body)) ground.solids.push_back(solid);
    }
    grounds_.push_back(std::move(ground));
  }
  points_.reserve(8 * scene.bodies.size() + 32);
  way_.reserve(scene.bodies.size());
  near_.reserve(12 * scene.bodies.size() + 32);
}

void Detector::look_ahead(const Scene& scene, const State& state, double ahead) {
  way_.clear();
  if (ahead == 0.0) return;
  const double gained = scene.effects.gravity ? ahead * scene.gravity.norm() : 0.0;
  for (std::size_t i = 0; i < radius_.size(); ++i) {
    way_.push_back(scene.bodies[i].is_static
                       ? 0.0
                       : ahead * (fastest_point(scene.bodies[i], state.u[i]) + gained));
  }
}

std::span<const BroadPhase::Pair> Detector::within_reach(const Scene& scene, const Part& part,
                                                         const State& state,
                                                         std::span<const Mat3> R_WB,
                                                         std::span<const double> way) {
  broad_phase_.update(scene, part, state, R_WB, way);
  near_.clear();
  std::copy_if(broad_phase_.pairs().begin(), broad_phase_.pairs().end(), std::back_inserter(near_),
               [&](const BroadPhase::Pair& pair) {
                 return part.holds(pair.i) && part.holds(pair.j) &&
                        broad_phase_.overlap(state, pair);
               });
  return near_;
}

std::span<const ContactPoint> Detector::detect(const Scene& scene, const Part& part,
                                               const State& state, std::span<const Mat3> R_WB,
                                               double ahead) {
  points_.clear();
  look_ahead(scene, state, ahead);
  const auto at = [](int body) { return static_cast<std::size_t>(body); };
  const auto margin = [&](int i, int j) {
    return way_.empty() ? scene.contact.margin : scene.contact.margin + way_[at(i)] + way_[at(j)];
  };
  const auto shape = [&](int body) -> const Shape& { return scene.bodies[at(body)].shape; };
  const auto placed = [&](int body) { return Placed{body, state.x[at(body)], R_WB[at(body)]}; };

  for (const Ground& ground : grounds_) {
    const Placed plane = placed(ground.body);
    const Vec3 n = plane.R.col(1);
    for (const int body : ground.solids) {
      if (points_.size() > kMaxContacts) return points_;
      if (!part.holds(body)) continue;
      const double near = margin(body, ground.body);
      if (n.dot(state.x[at(body)] - plane.x) > radius_[at(body)] + near) continue;
      touch_plane(placed(body), shape(body), plane, near, points_);
    }
  }
  broad_phase_.update(scene, part, state, R_WB, way_);
  for (const BroadPhase::Pair& pair : broad_phase_.pairs()) {
    if (too_many()) return points_;
    if (!part.holds(pair.i) || !part.holds(pair.j)) continue;
    if (!broad_phase_.overlap(state, pair)) continue;
    touch_solids(placed(pair.i), shape(pair.i), placed(pair.j), shape(pair.j),
                 margin(pair.i, pair.j), points_);
  }
  return points_;
}

}  // namespace substep
