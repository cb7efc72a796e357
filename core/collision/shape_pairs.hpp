#pragma once
// One file per pair of shapes. Each appends the points of the pair with a gap of at most `margin`.

#include <vector>

#include "core/collision/contact_id.hpp"
#include "core/collision/contact_point.hpp"
#include "core/model/shape.hpp"

namespace substep {

/// Where the shape of a body is.
struct Placed {
  int body;       // index into Scene::bodies
  const Vec3& x;  // centre, world [m]
  const Mat3& R;  // R_WB
};

using ContactPoints = std::vector<ContactPoint>;

void sphere_plane(const Placed& a, const Sphere& sphere, const Placed& b, double margin,
                  ContactPoints& out);
void sphere_sphere(const Placed& a, const Sphere& sphere_a, const Placed& b, const Sphere& sphere_b,
                   double margin, ContactPoints& out);
void sphere_box(const Placed& a, const Sphere& sphere, const Placed& b, const Box& box,
                double margin, ContactPoints& out);
/// One point per corner; the feature is the corner.
void box_plane(const Placed& a, const Box& box, const Placed& b, double margin, ContactPoints& out);
/// Face against face: the corners of the incident face clipped by the sides of the reference face.
/// Edge against edge: one point (box_edges.hpp).
void box_box(const Placed& a, const Box& box_a, const Placed& b, const Box& box_b, double margin,
             ContactPoints& out);

}  // namespace substep
