#pragma once
// Level of detail of bodies: the fewest vertices whose outline is accurate on the screen.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "app/render/picture.hpp"

namespace substep {

/// Segments of the meshes for boxes and for balls, from coarse to fine (rounded_box()).
inline constexpr std::array<int, 3> kBoxSegments{0, 1, 3};
inline constexpr std::array<int, 5> kBallSegments{0, 1, 2, 3, 8};

/// Distance of a mesh from the exact shape, relative to its rounding radius.
double outline_error(int segments);

/// Vertices of a mesh. @param flats see rounded_box()
int vertices_of(int segments, bool flats);

/// Inputs of the choice.
struct DetailNeeds {
  const Picture* picture = nullptr;  // for its projection
  int width = 0;                     // of the target [pixel]
  int height = 0;
  double tolerance = 0.5;  // of outlines [pixel]
  int vertices = 0;  // of all bodies together, as far as the coarsest meshes allow: past it the
                     // tolerance grows
};

/// Bodies by mesh, each list sorted from near to far, so that hidden fragments are not shaded. Of
/// bodies smaller than a pixel, one per pixel is drawn.
struct DetailedBodies {
  std::array<std::vector<Instance>, kBoxSegments.size()> boxes;
  std::array<std::vector<Instance>, kBallSegments.size()> balls;

  void choose(std::span<const Instance> all_boxes, std::span<const Instance> all_balls,
              const DetailNeeds& needs);
  /// Of all meshes.
  [[nodiscard]] std::size_t vertices() const;

 private:
  void thin_out_specks(const DetailNeeds& needs);

  std::vector<bool> taken_;  // per pixel of the target
};

}  // namespace substep
