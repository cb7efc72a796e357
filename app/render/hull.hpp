#pragma once

#include <vector>

namespace substep {

/// A point of a picture.
struct ScreenPoint {
  float x = 0.0F;
  float y = 0.0F;
};

/// The convex hull in order around it, by Andrew's monotone chain.
std::vector<ScreenPoint> convex_hull(std::vector<ScreenPoint> points);

}  // namespace substep
