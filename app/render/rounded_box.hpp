#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace substep {

/// The unit box. Rounding moves each vertex out along its normal; a fully rounded box is a ball.
struct RoundedBoxMesh {
  struct Vertex {
    std::array<float, 3> corner;
    std::array<float, 3> normal;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;  // of triangles, counter-clockwise from outside
};

/// @param segments per eighth of a turn; 0: sharp edges
/// @param flats false: without the flat faces, which are degenerate at full rounding
RoundedBoxMesh rounded_box(int segments, bool flats);

}  // namespace substep
