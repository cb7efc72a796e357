#include "app/render/contact_shadows.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace substep {
namespace {

constexpr double kFaintest = 0.03;      // fainter shadows are left out [-]
constexpr double kLowestPart = 0.4;     // of a body's height: the part that makes the footprint [-]
constexpr double kBallFootprint = 0.6;  // of a ball's radius [-]
constexpr double kSoft = 0.45;          // softness of a body on the floor, of its height [-]
constexpr double kMostSoft = 0.5;       // the same, of its footprint: a tower casts no wide shadow

// The plane of the floor.
struct FloorFrame {
  Vec3 origin;
  Vec3 normal;
  [[nodiscard]] double height(const Vec3& x) const { return normal.dot(x - origin); }
  [[nodiscard]] Vec3 below(const Vec3& x) const { return x - height(x) * normal; }
};

// The footprint of a body, in the plane of the floor.
struct Footprint {
  Vec3 centre;          // on the floor [m]
  Vec3 along;           // unit
  double half_u = 0.0;  // [m]
  double half_v = 0.0;  // [m]
  double lowest = 0.0;  // of the body above the floor [m]
  double height = 0.0;  // of the body itself [m]
  bool round = false;
};

std::optional<SoftShadow> shadow_of(const Footprint& print) {
  const double lowest = std::max(0.0, print.lowest);
  // About the share of the sky above a point on the floor that a plate of this size hides.
  const double area = print.half_u * print.half_v;
  const double strength = area / (area + 3.0 * lowest * lowest);
  if (!(strength > kFaintest)) return std::nullopt;
  const double wide = std::max(print.half_u, print.half_v);
  SoftShadow shadow;
  shadow.centre = print.centre.cast<float>();
  shadow.along = print.along.cast<float>();
  shadow.half_u = static_cast<float>(print.half_u);
  shadow.half_v = static_cast<float>(print.half_v);
  shadow.softness = static_cast<float>(std::min(kSoft * print.height, kMostSoft * wide) + lowest);
  shadow.strength = static_cast<float>(strength);
  shadow.round = print.round ? 1.0F : 0.0F;
  return shadow;
}

// The corners of a box below a height, and where its edges cross it.
std::vector<Vec3> lower_part(const std::array<Vec3, 8>& corners, const FloorFrame& floor,
                             double top) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double here = floor.height(corners[i]);
    if (here <= top) points.push_back(corners[i]);
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const std::size_t j = i | bit;
      const double there = floor.height(corners[j]);
      if (j == i || (here <= top) == (there <= top)) continue;
      points.push_back(corners[i] + (top - here) / (there - here) * (corners[j] - corners[i]));
    }
  }
  return points;
}

// The direction in the floor of the edge that is longest there: it turns with the body.
Vec3 direction_of(const RoundedBox& box, const Quat& q, const Vec3& normal) {
  Vec3 longest = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = q * (box.half_extents[i] * Vec3::Unit(i));
    const Vec3 flat = edge - normal * normal.dot(edge);
    if (flat.squaredNorm() > longest.squaredNorm()) longest = flat;
  }
  return longest.normalized();
}

Footprint footprint_of_ball(double radius, const FloorFrame& floor, const Vec3& x) {
  const double half = kBallFootprint * radius;
  const Vec3 u = floor.normal.unitOrthogonal();
  return {floor.below(x), u, half, half, floor.height(x) - radius, 2.0 * radius, true};
}

Footprint footprint_of_box(const RoundedBox& box, const FloorFrame& floor, const Vec3& x,
                           const Quat& q) {
  std::array<Vec3, 8> corners;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 sign((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
    corners[i] = x + q * box.half_extents.cwiseProduct(sign);
    low = std::min(low, floor.height(corners[i]));
    high = std::max(high, floor.height(corners[i]));
  }
  const Vec3 u = direction_of(box, q, floor.normal);
  const Vec3 v = floor.normal.cross(u);
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 most = -least;
  for (const Vec3& p : lower_part(corners, floor, low + kLowestPart * (high - low))) {
    const Vec2 at(u.dot(p - x), v.dot(p - x));
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  }
  const Vec2 middle = 0.5 * (least + most);
  const Vec2 half = 0.5 * (most - least);
  const Vec3 at = floor.below(x + middle.x() * u + middle.y() * v);
  return {at, u, half.x(), half.y(), low, high - low, false};
}

}  // namespace

std::vector<SoftShadow> contact_shadows(const Scene& scene, const Poses& poses,
                                        const Ground& ground) {
  std::vector<SoftShadow> shadows;
  const FloorFrame floor{ground.origin.cast<double>(), ground.normal.cast<double>().normalized()};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const double above = floor.height(poses.x[i]);
    const double reach = radius_around(body.shape);
    // Skips bodies that have fallen through the floor, bodies far above it, and NaN.
    if (!(above > -reach) || !(above < 8.0 * reach)) continue;
    const auto solid = outline(body.shape);
    if (!solid) continue;
    const Footprint print = solid->is_ball()
                                ? footprint_of_ball(solid->rounding, floor, poses.x[i])
                                : footprint_of_box(*solid, floor, poses.x[i], poses.q[i]);
    if (const auto shadow = shadow_of(print)) shadows.push_back(*shadow);
  }
  return shadows;
}

}  // namespace substep
