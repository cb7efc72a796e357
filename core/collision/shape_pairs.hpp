#pragma once
// One file per pair of shapes. Each appends the points of the pair with a gap of at most `margin`.

#include <type_traits>
#include <variant>
#include <vector>

#include "core/collision/contact_point.hpp"
#include "core/model/shape.hpp"

namespace substep {

/// Placement of a body's shape.
struct Placed {
  int body;       // index into Scene::bodies
  const Vec3& x;  // centre, world [m]
  const Mat3& R;  // R_WB
};

using ContactPoints = std::vector<ContactPoint>;

/// Appends a point. @param feature the touching features of the pair  @return the point, to set
/// field_arm and H unless they are zero
inline ContactPoint& add_point(const Placed& a, const Placed& b, std::uint64_t feature,
                               const Vec3& n, double gap, const Vec3& point_a, const Vec3& point_b,
                               ContactPoints& out) {
  const std::uint64_t id = contact_id(a.body, b.body, feature);
  out.push_back({a.body, b.body, id, n, gap, point_a, point_b});
  return out.back();
}

// One overload of touch() for every pair of Shape alternatives; only the second may be a plane. A
// missing overload is a compile error.

void touch(const Placed& a, const Sphere& sphere, const Placed& b, const Plane& plane,
           double margin, ContactPoints& out);
void touch(const Placed& a, const Sphere& sphere_a, const Placed& b, const Sphere& sphere_b,
           double margin, ContactPoints& out);
void touch(const Placed& a, const Sphere& sphere, const Placed& b, const Box& box, double margin,
           ContactPoints& out);
inline void touch(const Placed& a, const Box& box, const Placed& b, const Sphere& sphere,
                  double margin, ContactPoints& out) {
  touch(b, sphere, a, box, margin, out);
}
/// One point per corner; the feature is the corner.
void touch(const Placed& a, const Box& box, const Placed& b, const Plane& plane, double margin,
           ContactPoints& out);
/// Face against face: the corners of the incident face clipped by the sides of the reference face.
/// Edge against edge: one point.
void touch(const Placed& a, const Box& box_a, const Placed& b, const Box& box_b, double margin,
           ContactPoints& out);

/// Of 15 axes, that along which two boxes are farthest apart.
struct BoxAxis {
  Vec3 n = Vec3::UnitY();  // unit, from b to a, world
  double gap = 0.0;        // < 0 when overlapping [m]
};
BoxAxis separating_axis(const Placed& a, const Box& box_a, const Placed& b, const Box& box_b);

/// @param a not a plane: planes are static, and static bodies do not collide with each other
inline void touch_shapes(const Placed& a, const Shape& shape_a, const Placed& b,
                         const Shape& shape_b, double margin, ContactPoints& out) {
  std::visit(
      [&](const auto& x, const auto& y) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(x)>, Plane>) {
          touch(a, x, b, y, margin, out);
        }
      },
      shape_a, shape_b);
}

}  // namespace substep
