#pragma once
// How finely each body is drawn: with the fewest vertices whose outline is true on the screen.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "app/render/picture.hpp"

namespace substep {

/// Segments of the meshes for boxes and for balls, from coarse to fine (rounded_box()).
inline constexpr std::array<int, 3> kBoxSegments{0, 1, 3};
inline constexpr std::array<int, 5> kBallSegments{0, 1, 2, 3, 8};

/// How far a mesh lies off the shape that it stands for, as a share of its rounding radius.
double outline_error(int segments);

/// Vertices of a mesh. @param flats as rounded_box() takes them
int vertices_of(int segments, bool flats);

/// What the choice depends on.
struct DetailNeeds {
  const Picture* picture = nullptr;  // for its projection
  int width = 0;                     // of the target [pixel]
  int height = 0;
  double tolerance = 0.5;  // of outlines [pixel]
  int vertices = 0;  // of all bodies together, as far as the coarsest meshes allow: past it the
                     // tolerance grows
};

/// Bodies by the mesh that draws them; those of a mesh from the nearest to the farthest, so that
/// what lies behind another is not shaded. Of bodies smaller than a pixel one per pixel is drawn.
struct DetailedBodies {
  std::array<std::vector<Instance>, kBoxSegments.size()> boxes;
  std::array<std::vector<Instance>, kBallSegments.size()> balls;

  void choose(std::span<const Instance> all_boxes, std::span<const Instance> all_balls,
              const DetailNeeds& needs);
  /// Of all meshes together.
  [[nodiscard]] std::size_t vertices() const;

 private:
  void thin_out_specks(const DetailNeeds& needs);

  std::vector<bool> taken_;  // per pixel of the target
};

}  // namespace substep
