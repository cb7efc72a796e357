// The convex hull of points, and its mass properties.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/import/solid.hpp"

namespace substep {
namespace {

/// Indices of its corners, anticlockwise from outside.
using Triangle = std::array<std::size_t, 3>;

class Hull {
 public:
  explicit Hull(std::vector<Vec3> points) : points_(std::move(points)) {}

  /// Adds one point after the other: the faces that see it are replaced by those that join it to
  /// their rim. @return false if the points are in a plane
  bool build() {
    if (!start()) return false;
    for (std::size_t i = 0; i < points_.size(); ++i) add(i);
    return true;
  }

  /// Sums tetrahedra from the first point to each face.
  [[nodiscard]] MassProperties solid() const {
    const Vec3 origin = points_.front();
    double volume = 0.0;
    Vec3 first = Vec3::Zero();   // integral of x
    Mat3 second = Mat3::Zero();  // integral of x x^T
    for (const Triangle& face : faces_) {
      const Vec3 a = points_[face[0]] - origin;
      const Vec3 b = points_[face[1]] - origin;
      const Vec3 c = points_[face[2]] - origin;
      const double part = a.dot(b.cross(c)) / 6.0;
      const Vec3 sum = a + b + c;
      volume += part;
      first += part / 4.0 * sum;
      second += part / 20.0 *
                (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    const Vec3 centre = first / volume;
    const Mat3 spread = second - volume * centre * centre.transpose();
    return {volume, origin + centre, spread.trace() * Mat3::Identity() - spread};
  }

 private:
  [[nodiscard]] double height(const Triangle& face, std::size_t point) const {
    const Vec3& a = points_[face[0]];
    const Vec3 normal = (points_[face[1]] - a).cross(points_[face[2]] - a);
    const double length = normal.norm();
    return length > 0.0 ? normal.dot(points_[point] - a) / length : 0.0;
  }

  /// A tetrahedron of points far from each other.
  bool start() {
    if (points_.size() < 4) return false;
    const auto farthest = [&](auto&& distance) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < points_.size(); ++i) {
        if (distance(i) > distance(best)) best = i;
      }
      return best;
    };
    const std::size_t a = 0;
    const std::size_t b = farthest([&](std::size_t i) { return (points_[i] - points_[a]).norm(); });
    const Vec3 along = (points_[b] - points_[a]).normalized();
    const std::size_t c =
        farthest([&](std::size_t i) { return (points_[i] - points_[a]).cross(along).norm(); });
    const Triangle base{a, b, c};
    const std::size_t d = farthest([&](std::size_t i) { return std::abs(height(base, i)); });
    tolerance_ = 1e-12 * (points_[b] - points_[a]).norm();
    if (!(std::abs(height(base, d)) > 1e3 * tolerance_)) return false;
    const bool is_above = height(base, d) > 0.0;
    const std::size_t p = is_above ? c : b;
    const std::size_t q = is_above ? b : c;
    faces_ = {{a, p, q}, {a, d, p}, {p, d, q}, {q, d, a}};
    return true;
  }

  void add(std::size_t point) {
    std::set<std::pair<std::size_t, std::size_t>> rim;
    std::vector<Triangle> kept;
    for (const Triangle& face : faces_) {
      if (height(face, point) <= tolerance_) {
        kept.push_back(face);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = face[i];
        const std::size_t to = face[(i + 1) % 3];
        if (rim.erase({to, from}) == 0) rim.emplace(from, to);
      }
    }
    if (rim.empty()) return;
    for (const auto& [from, to] : rim) kept.push_back({from, to, point});
    faces_ = std::move(kept);
  }

  std::vector<Vec3> points_;
  std::vector<Triangle> faces_;
  double tolerance_ = 0.0;  // points this close to a face are on it [m]
};

}  // namespace

std::optional<MassProperties> hull_properties(std::span<const Vec3> points) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::vector<Vec3> distinct(points.begin(), points.end());
  std::sort(distinct.begin(), distinct.end(), less);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  if (distinct.size() > kMostHullPoints) return std::nullopt;
  Hull hull(std::move(distinct));
  if (!hull.build()) return std::nullopt;
  const MassProperties solid = hull.solid();
  if (!(solid.mass > 0.0) || !solid.inertia.allFinite()) return std::nullopt;
  return solid;
}

}  // namespace substep
