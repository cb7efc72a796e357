#include "app/render/picking.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace substep {
namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

// Entry of a ray from outside into a ball about the origin. @return distance, or kMiss
double enter_ball(double radius, const Vec3& from, const Vec3& along) {
  const double middle = -from.dot(along);
  const double half_squared = radius * radius - (from + middle * along).squaredNorm();
  if (half_squared < 0.0) return kMiss;
  const double distance = middle - std::sqrt(half_squared);
  return distance >= 0.0 ? distance : kMiss;
}

// The same for a box by the slab method.
double enter_box(const Vec3& half_extents, const Vec3& from, const Vec3& along) {
  double first = 0.0;
  double last = kMiss;
  for (int i = 0; i < 3; ++i) {
    const double half = half_extents[i];
    if (along[i] == 0.0) {
      if (std::abs(from[i]) > half) return kMiss;
      continue;
    }
    const double a = (-half - from[i]) / along[i];
    const double b = (half - from[i]) / along[i];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last && first > 0.0 ? first : kMiss;
}

}  // namespace

Ray ray_through(const Eigen::Matrix4d& view_projection, double x, double y) {
  const Eigen::Matrix4d back = view_projection.inverse();
  const auto point = [&](double depth) {
    const Eigen::Vector4d p = back * Eigen::Vector4d(x, y, depth, 1.0);
    return Vec3(p.head<3>() / p.w());
  };
  const Vec3 near = point(-1.0);
  return {near, (point(1.0) - near).normalized()};
}

std::optional<Hit> first_hit(const Ray& ray, const Scene& scene, const Poses& poses) {
  Hit best{-1, kMiss};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto solid = outline(scene.bodies[i].shape);
    if (!solid) continue;
    const Quat to_body = poses.q[i].conjugate();
    const Vec3 from = to_body * (ray.origin - poses.x[i]);
    const Vec3 along = to_body * ray.direction;
    const double distance = solid->is_ball() ? enter_ball(solid->rounding, from, along)
                                             : enter_box(solid->half_extents, from, along);
    if (distance < best.distance) best = {static_cast<int>(i), distance};
  }
  if (best.body < 0) return std::nullopt;
  return best;
}

}  // namespace substep
