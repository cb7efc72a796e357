#include "app/render/detail.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace substep {
namespace {

constexpr double kMostTolerance = 1e4;  // the coarsest mesh for every body [pixel]
constexpr double kCube = 2.0;           // allowed deviation of a cube drawn for a ball [pixel]
constexpr double kSpeck = 0.5;          // radius of a body that fits into a pixel [pixel]

// Minimum depth, as a divisor in the projection [m].
double depth(const Instance& body, const Picture& picture) {
  const auto row = picture.view_projection.row(3).cast<double>();
  double w = row(3);
  for (int i = 0; i < 3; ++i) {
    w += row(i) * static_cast<double>(body.position[i]);
  }
  return w;
}

double reach(const Instance& body) {
  const auto& half = body.half_extents;
  return static_cast<double>(std::hypot(half[0], half[1], half[2]));
}

// The coarsest mesh with an accurate outline. @param radius of the rounding on the screen [pixel]
template <std::size_t kCount>
std::size_t level_of(double radius, double tolerance, const std::array<int, kCount>& segments) {
  std::size_t level = 0;
  const auto allowed = [&] { return segments[level] > 0 ? tolerance : std::min(tolerance, kCube); };
  while (level + 1 < kCount && outline_error(segments[level]) * radius > allowed()) ++level;
  return level;
}

// Pixels per metre at a depth of 1 m.
double focal_length(const DetailNeeds& needs) {
  const auto row = needs.picture->view_projection.row(1).head<3>();
  return 0.5 * needs.height * static_cast<double>(row.norm());
}

// The pixel of a body's centre, from the lower left corner; -1 outside.
std::ptrdiff_t pixel_of(const Instance& body, const DetailNeeds& needs) {
  const auto& m = needs.picture->view_projection;
  const Eigen::Vector4f at =
      m * Eigen::Vector4f(body.position[0], body.position[1], body.position[2], 1.0F);
  const auto pixel = [&](float clip, int size) {
    return static_cast<std::ptrdiff_t>(0.5F * (clip / at.w() + 1.0F) * static_cast<float>(size));
  };
  if (!(at.w() > 0.0F) || std::abs(at.x()) >= at.w() || std::abs(at.y()) >= at.w()) return -1;
  return pixel(at.y(), needs.height) * needs.width + pixel(at.x(), needs.width);
}

template <std::size_t kCount>
void sort_into(std::array<std::vector<Instance>, kCount>& levels, std::span<const Instance> bodies,
               const std::array<int, kCount>& segments, const DetailNeeds& needs,
               double tolerance) {
  for (auto& level : levels) level.clear();
  const double focal = focal_length(needs);
  for (const Instance& body : bodies) {
    // Its nearest point has the largest projection.
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
                           const std::array<int, kCount>& segments, bool flats) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    count += levels[i].size() * static_cast<std::size_t>(vertices_of(segments[i], flats));
  }
  return count;
}

}  // namespace

double outline_error(int segments) {
  if (segments == 0) return std::numbers::sqrt3 - 1.0;  // a sharp corner
  // Lines of its grid; the diagonals of cells deviate up to 2.51 times as much.
  return 2.51 * (1.0 - std::cos(std::numbers::pi / (8.0 * segments)));
}

int vertices_of(int segments, bool flats) {
  const int lines = flats || segments == 0 ? 2 * (segments + 1) : 2 * segments + 1;
  return 6 * lines * lines;
}

std::size_t DetailedBodies::vertices() const {
  return count_vertices(boxes, kBoxSegments, true) + count_vertices(balls, kBallSegments, false);
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
  thin_out_specks(needs);
}

void DetailedBodies::thin_out_specks(const DetailNeeds& needs) {
  if (boxes.front().empty() && balls.front().empty()) return;
  taken_.assign(static_cast<std::size_t>(needs.width) * static_cast<std::size_t>(needs.height),
                false);
  const double focal = focal_length(needs);
  for (auto* specks : {&boxes.front(), &balls.front()}) {
    std::erase_if(*specks, [&](const Instance& body) {
      if (reach(body) * focal > kSpeck * depth(body, *needs.picture)) return false;
      const std::ptrdiff_t pixel = pixel_of(body, needs);
      if (pixel < 0) return false;
      const auto at = static_cast<std::size_t>(pixel);
      const bool again = taken_[at];
      taken_[at] = true;
      return again;
    });
  }
}

}  // namespace substep
