#include "core/collision/detector.hpp"

#include <algorithm>
#include <iterator>

#include "core/forces/applied_forces.hpp"

namespace substep {

namespace {

// Within these parts of a half width shapes touch: the smaller one if they move by more than
// kSlow half widths in the sub-step, because the normal then turns on the way.
constexpr double kTouchingSlowly = 1e-2;
constexpr double kTouchingFast = 1e-4;
constexpr double kSlow = 0.03;

bool is_box(const Scene& scene, int body) {
  return std::holds_alternative<Box>(scene.bodies[index(body)].shape);
}

}  // namespace

double way_in(double time, const Scene& scene, const Body& body, const Vec6& u) {
  if (body.is_static) return 0.0;
  return time * (fastest_point(body, u) + time * acceleration_bound(scene, body));
}

Detector::Detector(const Scene& scene) : broad_phase_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (!body.collides || !std::holds_alternative<Plane>(body.shape)) continue;
    Ground ground{static_cast<int>(i), {}};
    for (const int solid : broad_phase_.solids()) {
      if (broad_phase_.may_touch(scene, solid, ground.body)) ground.solids.push_back(solid);
    }
    grounds_.push_back(std::move(ground));
  }
  for (const Body& body : scene.bodies) {
    half_width_.push_back(
        std::visit([](const auto& shape) { return shape.half_width(); }, body.shape));
  }
  points_.reserve(8 * scene.bodies.size() + 32);
  way_.reserve(scene.bodies.size());
  near_.reserve(12 * scene.bodies.size() + 32);
  listed_.reserve(12 * scene.bodies.size() + 32);
}

void Detector::look_ahead(const Scene& scene, const State& state, double ahead) {
  way_.clear();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    way_.push_back(way_in(ahead, scene, scene.bodies[i], state.u[i]));
  }
}

double Detector::margin(const Scene& scene, int i, int j) const {
  if (touching_) {
    const double width = half_width(i, j);
    const bool slow = way_[index(i)] + way_[index(j)] <= kSlow * width;
    return (slow ? kTouchingSlowly : kTouchingFast) * width;
  }
  return way_.empty() ? scene.contact.margin
                      : scene.contact.margin + way_[index(i)] + way_[index(j)];
}

std::span<const BroadPhase::Pair> Detector::within_reach(const Scene& scene, const Part& part,
                                                         const State& state,
                                                         std::span<const Mat3> R_WB,
                                                         std::span<const double> way) {
  broad_phase_.update(scene, part, state, R_WB, way);
  near_.clear();
  visits_ += std::ssize(broad_phase_.pairs());
  std::copy_if(broad_phase_.pairs().begin(), broad_phase_.pairs().end(), std::back_inserter(near_),
               [&](const BroadPhase::Pair& pair) {
                 return part.holds(pair.i) && part.holds(pair.j) &&
                        broad_phase_.overlap(state, pair);
               });
  return near_;
}

void Detector::touch(const Scene& scene, const State& state, std::span<const Mat3> R_WB,
                     const BroadPhase::Pair& pair) {
  const auto [i, j] = pair;
  touch_shapes({i, state.x[index(i)], R_WB[index(i)]}, scene.bodies[index(i)].shape,
               {j, state.x[index(j)], R_WB[index(j)]}, scene.bodies[index(j)].shape,
               margin(scene, i, j), points_);
}

void Detector::find(const Scene& scene, const Part& part, const State& state,
                    std::span<const Mat3> R_WB, Pairs* boxes) {
  points_.clear();
  broad_phase_.update(scene, part, state, R_WB, way_);
  for (const Ground& ground : grounds_) {
    const Placed plane{ground.body, state.x[index(ground.body)], R_WB[index(ground.body)]};
    const Vec3 n = plane.R.col(1);
    visits_ += std::ssize(ground.solids);
    for (const int body : ground.solids) {
      if (points_.size() > limit_) return;
      if (!part.holds(body)) continue;
      const double near = margin(scene, body, ground.body);
      const double reach = broad_phase_.reach(body).dot(n.cwiseAbs());
      if (n.dot(state.x[index(body)] - plane.x) > reach + near) continue;
      touch_shapes({body, state.x[index(body)], R_WB[index(body)]}, scene.bodies[index(body)].shape,
                   plane, Plane{}, near, points_);
    }
  }
  visits_ += std::ssize(broad_phase_.pairs());
  for (const BroadPhase::Pair& pair : broad_phase_.pairs()) {
    if (too_many()) return;
    if (!part.holds(pair.i) || !part.holds(pair.j)) continue;
    if (!broad_phase_.overlap(state, pair)) continue;
    if (boxes != nullptr && is_box(scene, pair.i) && is_box(scene, pair.j)) {
      boxes->push_back(pair);
    } else {
      touch(scene, state, R_WB, pair);
    }
  }
}

std::span<const ContactPoint> Detector::detect(const Scene& scene, const Part& part,
                                               const State& state, std::span<const Mat3> R_WB) {
  way_.clear();
  find(scene, part, state, R_WB, nullptr);
  return points_;
}

std::span<const ContactPoint> Detector::detect_touching(const Scene& scene, const Part& part,
                                                        const State& state,
                                                        std::span<const Mat3> R_WB, double dt) {
  find_ways(scene, state.u, dt);
  touching_ = true;
  find(scene, part, state, R_WB, nullptr);
  touching_ = false;
  return points_;
}

void Detector::find_ways(const Scene& scene, std::span<const Vec6> w, double dt) {
  way_.clear();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    way_.push_back(body.is_static ? 0.0 : dt * fastest_point(body, w[i]));
  }
}

std::span<const BroadPhase::Pair> Detector::may_meet(const Scene& scene, const Part& part,
                                                     const State& state, std::span<const Mat3> R_WB,
                                                     std::span<const Vec6> w, double dt) {
  find_ways(scene, w, dt);
  within_reach(scene, part, state, R_WB, way_);
  for (const Ground& ground : grounds_) {
    const Vec3 n = R_WB[index(ground.body)].col(1);
    visits_ += std::ssize(ground.solids);
    for (const int body : ground.solids) {
      if (!part.holds(body)) continue;
      const double height = n.dot(state.x[index(body)] - state.x[index(ground.body)]);
      if (height <= broad_phase_.reach(body).dot(n.cwiseAbs()))
        near_.push_back({body, ground.body});
    }
  }
  return near_;
}

std::span<const ContactPoint> Detector::predict(const Scene& scene, const Part& part,
                                                const State& state, std::span<const Mat3> R_WB,
                                                double ahead) {
  look_ahead(scene, state, ahead);
  listed_.clear();
  find(scene, part, state, R_WB, &listed_);
  return points_;
}

std::span<const ContactPoint> Detector::detect_listed(const Scene& scene, const Part& part,
                                                      const State& state,
                                                      std::span<const Mat3> R_WB, double ahead) {
  look_ahead(scene, state, ahead);
  points_.clear();
  visits_ += std::ssize(listed_);
  for (const BroadPhase::Pair& pair : listed_) {
    if (too_many()) break;
    if (part.holds(pair.i) && part.holds(pair.j)) touch(scene, state, R_WB, pair);
  }
  return points_;
}

}  // namespace substep
