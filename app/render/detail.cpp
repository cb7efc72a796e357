#include "app/render/detail.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace substep {
namespace {

constexpr double kMostTolerance = 1e4;  // every body is as coarse as it can be [pixel]

// Along the view, where the projection divides by it [m].
double depth(const Instance& body, const Picture& picture) {
  const auto row = picture.view_projection.row(3).cast<double>();
  double w = row(3);
  for (int i = 0; i < 3; ++i) {
    w += row(i) * static_cast<double>(body.position[static_cast<std::size_t>(i)]);
  }
  return w;
}

double reach(const Instance& body) {
  return std::hypot(body.half_extents[0], body.half_extents[1], body.half_extents[2]);
}

// The coarsest mesh whose outline is true. @param radius of the rounding on the screen [pixel]
template <std::size_t kCount>
std::size_t level_of(double radius, double tolerance, const std::array<int, kCount>& segments) {
  std::size_t level = 0;
  while (level + 1 < kCount && outline_error(segments[level]) * radius > tolerance) ++level;
  return level;
}

template <std::size_t kCount>
void sort_into(std::array<std::vector<Instance>, kCount>& levels, std::span<const Instance> bodies,
               const std::array<int, kCount>& segments, const DetailNeeds& needs,
               double tolerance) {
  for (auto& level : levels) level.clear();
  const double focal = 0.5 * needs.height *
                       static_cast<double>(needs.picture->view_projection.row(1).head<3>().norm());
  for (const Instance& body : bodies) {
    // The nearest point of it is seen largest.
    const double w = std::max(1e-3, depth(body, *needs.picture) - reach(body));
    const double radius = static_cast<double>(body.rounding) * focal / w;
    levels[level_of(radius, tolerance, segments)].push_back(body);
  }
}

void sort_by_depth(std::vector<Instance>& bodies, const Picture& picture) {
  std::sort(bodies.begin(), bodies.end(), [&](const Instance& a, const Instance& b) {
    return depth(a, picture) - reach(a) < depth(b, picture) - reach(b);
  });
}

template <std::size_t kCount>
std::size_t count_vertices(const std::array<std::vector<Instance>, kCount>& levels,
                           const std::array<int, kCount>& segments) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    count += levels[i].size() * static_cast<std::size_t>(vertices_of(segments[i]));
  }
  return count;
}

}  // namespace

double outline_error(int segments) {
  if (segments == 0) return std::numbers::sqrt3 - 1.0;  // a corner that is not rounded
  return 1.0 - std::cos(std::numbers::pi / (8.0 * segments));
}

int vertices_of(int segments) {
  const int lines = 2 * (segments + 1);
  return 6 * lines * lines;
}

std::size_t DetailedBodies::vertices() const {
  return count_vertices(boxes, kBoxSegments) + count_vertices(balls, kBallSegments);
}

void DetailedBodies::choose(std::span<const Instance> all_boxes,
                            std::span<const Instance> all_balls, const DetailNeeds& needs) {
  for (double tolerance = needs.tolerance; tolerance < kMostTolerance; tolerance *= 2.0) {
    sort_into(boxes, all_boxes, kBoxSegments, needs, tolerance);
    sort_into(balls, all_balls, kBallSegments, needs, tolerance);
    if (vertices() <= static_cast<std::size_t>(needs.vertices)) break;
  }
  for (auto& level : boxes) sort_by_depth(level, *needs.picture);
  for (auto& level : balls) sort_by_depth(level, *needs.picture);
}

}  // namespace substep
