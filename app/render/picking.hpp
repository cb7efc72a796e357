#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/lab/session.hpp"

namespace substep {

struct Ray {
  Vec3 origin = Vec3::Zero();       // world [m]
  Vec3 direction = -Vec3::UnitZ();  // unit, world

  [[nodiscard]] Vec3 at(double distance) const { return origin + distance * direction; }
};

/// The ray through a point of the window. @param x, y clip coordinates, -1..1, y up
Ray ray_through(const Eigen::Matrix4d& view_projection, double x, double y);

struct Hit {
  int body = 0;
  double distance = 0.0;  // along the ray [m]
};

/// The first sphere or box hit by a ray; planes are ignored.
std::optional<Hit> first_hit(const Ray& ray, const Scene& scene, const Poses& poses);

}  // namespace substep
