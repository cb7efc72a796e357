#include "app/render/hull.hpp"

#include <algorithm>
#include <cstddef>

namespace substep {

std::vector<ScreenPoint> convex_hull(std::vector<ScreenPoint> points) {
  std::sort(points.begin(), points.end(), [](const ScreenPoint& a, const ScreenPoint& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  const auto left_turn = [](const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0F;
  };
  std::vector<ScreenPoint> hull;
  if (points.empty()) return hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const ScreenPoint& q : points) {
      while (hull.size() >= first + 2 && !left_turn(hull[hull.size() - 2], hull.back(), q)) {
        hull.pop_back();
      }
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace substep
