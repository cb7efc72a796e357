#include "app/render/fans.hpp"

#include <span>

namespace substep {
namespace {

constexpr unsigned kFewestCorners = 5;  // smallest number of corners worth slicing

/// An area whose corners are every `step`-th vertex from the first, in order around it.
struct Fan {
  ImDrawIdx first = 0;
  ImDrawIdx step = 0;
  ImDrawIdx corners = 0;  // 0: none

  [[nodiscard]] std::size_t indices() const { return 3 * (std::size_t{corners} - 2); }
  [[nodiscard]] ImDrawIdx corner(ImDrawIdx i) const { return first + step * (i % corners); }
};

// The fan at the beginning of the indices. Antialiased edges add a vertex to each corner.
Fan fan_at(std::span<const ImDrawIdx> indices) {
  if (indices.size() < 3) return {};
  const ImDrawIdx step = indices[2] - indices[1];
  if ((step != 1 && step != 2) || indices[1] != indices[0] + step) return {};
  Fan fan{indices[0], step, 2};
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3, ++fan.corners) {
    const ImDrawIdx corner = fan.first + step * fan.corners;
    if (indices[i] != fan.first || indices[i + 1] != corner - step || indices[i + 2] != corner) {
      break;
    }
  }
  return fan;
}

// The first corner of the highest edge.
ImDrawIdx top_edge(const Fan& fan, const ImDrawVert* vertices) {
  const auto height = [&](ImDrawIdx i) {
    return vertices[fan.corner(i)].pos.y + vertices[fan.corner(i + 1)].pos.y;
  };
  ImDrawIdx top = 0;
  for (ImDrawIdx i = 1; i < fan.corners; ++i) {
    if (height(i) < height(top)) top = i;
  }
  return top;
}

// Alternates between the two sides.
void slice(const Fan& fan, const ImDrawVert* vertices, std::span<ImDrawIdx> indices) {
  ImDrawIdx left = top_edge(fan, vertices) + fan.corners;  // goes down, round the area
  ImDrawIdx right = left + 1;
  for (std::size_t i = 0; i < fan.indices(); i += 3) {
    const bool at_left = i % 2 == 0;
    indices[i] = fan.corner(left);
    indices[i + 1] = fan.corner(right);
    indices[i + 2] = fan.corner(at_left ? --left : ++right);
  }
}

}  // namespace

void slice_fans(ImDrawData& panels) {
  for (ImDrawList* list : panels.CmdLists) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const std::span<ImDrawIdx> all(list->IdxBuffer.Data + command.IdxOffset, command.ElemCount);
      const ImDrawVert* vertices = list->VtxBuffer.Data + command.VtxOffset;
      for (std::size_t i = 0; i < all.size();) {
        const Fan fan = fan_at(all.subspan(i));
        if (fan.corners >= kFewestCorners) slice(fan, vertices, all.subspan(i, fan.indices()));
        i += fan.corners > 2 ? fan.indices() : 3;
      }
    }
  }
}

}  // namespace substep
