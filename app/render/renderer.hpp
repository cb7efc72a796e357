#pragma once

#include <imgui.h>

#include <cstdint>
#include <span>
#include <vector>

#include "app/render/picture.hpp"

namespace substep {

/// How finely the picture is drawn; the panels over it are always as sharp as the screen.
enum class Quality : unsigned char {
  kSketch,  // of a quarter of the pixels
  kCoarse,  // of fewer pixels
  kPlain,   // edges in steps
  kFine     // smooth edges
};

/// What a frame is drawn for.
struct DrawOptions {
  int width = 0;  // of the window's frame buffer [pixel]
  int height = 0;
  Quality moving = Quality::kFine;  // while a picture changes; what rests is drawn at its best
};

/// Draws pictures side by side and the panels over them. The window system belongs to the shell.
class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Before the panels are built: makes ready what Dear ImGui needs.
  virtual void begin_frame() = 0;
  virtual void draw(std::span<const Picture> pictures, ImDrawData& panels,
                    const DrawOptions& options) = 0;
  /// Whether draw() only begins a picture, which present() shows once it is finished.
  [[nodiscard]] virtual bool deferred() const { return false; }
  /// Shows what draw() began, before the next begin_frame().
  /// @param wait false: only where it is finished
  /// @return false where it is still being drawn
  virtual bool present(bool wait) { return static_cast<void>(wait), true; }
  /// What is shown, as RGB rows from the top; right after draw() or present().
  /// @param x, y from the top left corner [pixel]
  [[nodiscard]] virtual std::vector<std::uint8_t> pixels(int x, int y, int width, int height) = 0;
  /// The font atlas was rebuilt, for another pixel ratio.
  virtual void fonts_changed() = 0;
};

}  // namespace substep
