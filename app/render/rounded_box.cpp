#include "app/render/rounded_box.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace substep {
namespace {

// A line of a face's grid. On each half of a face the normal turns from the face's own (slope 0) to
// the edge (slope 1), where the neighbouring face begins; the flat is between the two middle lines.
// Without a flat they coincide.
struct Line {
  float side;   // -1 or 1: of which edge
  float slope;  // of the normal
};

std::vector<Line> lines_of(int segments, bool flats) {
  const auto slope = [&](int step) {
    if (segments == 0) return 0.0;
    return std::tan(0.25 * std::numbers::pi * step / segments);
  };
  std::vector<Line> lines;
  for (int i = -segments; i <= 0; ++i) lines.push_back({-1.0F, static_cast<float>(slope(i))});
  for (int i = flats ? 0 : 1; i <= segments; ++i)
    lines.push_back({1.0F, static_cast<float>(slope(i))});
  return lines;
}

void add_face(std::size_t axis, float sign, int segments, bool flats, RoundedBoxMesh& mesh) {
  const auto base = static_cast<int>(mesh.vertices.size());
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const std::vector<Line> lines = lines_of(segments, flats);
  for (const Line& a : lines) {
    for (const Line& b : lines) {
      RoundedBoxMesh::Vertex vertex{};
      vertex.corner[axis] = sign;
      vertex.corner[u] = a.side;
      vertex.corner[v] = b.side;
      const float length = std::sqrt(1.0F + a.slope * a.slope + b.slope * b.slope);
      vertex.normal[axis] = sign / length;
      vertex.normal[u] = a.slope / length;
      vertex.normal[v] = b.slope / length;
      mesh.vertices.push_back(vertex);
    }
  }
  const auto n = static_cast<int>(lines.size());
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int p = base + i * n + j;
      const std::array<int, 6> quad =
          sign > 0.0F ? std::array<int, 6>{p, p + n, p + 1, p + 1, p + n, p + n + 1}
                      : std::array<int, 6>{p, p + 1, p + n, p + 1, p + n + 1, p + n};
      for (const int index : quad) mesh.indices.push_back(static_cast<std::uint16_t>(index));
    }
  }
}

}  // namespace

RoundedBoxMesh rounded_box(int segments, bool flats) {
  RoundedBoxMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) add_face(axis, sign, segments, flats, mesh);
  }
  return mesh;
}

}  // namespace substep
