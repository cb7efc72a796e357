#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/render/picture.hpp"

struct ImDrawData;

namespace substep {

/// Draws pictures side by side and the panels over them. The window system belongs to the shell.
class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Before the panels are built: makes ready what Dear ImGui needs.
  virtual void begin_frame() = 0;
  /// @param width, height of the frame buffer [pixel]
  virtual void draw(std::span<const Picture> pictures, const ImDrawData& panels, int width,
                    int height) = 0;
  /// What was drawn last, as RGB rows from the top; asked for right after draw().
  /// @param x, y from the top left corner [pixel]
  [[nodiscard]] virtual std::vector<std::uint8_t> pixels(int x, int y, int width, int height) = 0;
  /// The font atlas was rebuilt, for another pixel ratio.
  virtual void fonts_changed() = 0;
};

}  // namespace substep
