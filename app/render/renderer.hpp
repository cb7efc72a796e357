#pragma once

#include <imgui.h>

#include <cstdint>
#include <span>
#include <vector>

#include "app/render/picture.hpp"

namespace substep {

/// Quality of the picture; the panels are always at full resolution.
enum class Quality : unsigned char {
  kSketch,  // a quarter of the pixels
  kCoarse,  // fewer pixels
  kPlain,   // aliased edges
  kFine     // smooth edges
};

/// Parameters of a frame.
struct DrawOptions {
  int width = 0;  // of the window's frame buffer [pixel]
  int height = 0;
  Quality moving = Quality::kFine;  // while the picture changes; at rest: the finest
  bool whole = true;  // false: without a graphics card, panels may keep what they showed before
};

/// Draws pictures side by side and the panels over them. The shell owns the window system.
class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Call before the panels are built: prepares the Dear ImGui backend.
  virtual void begin_frame() = 0;
  virtual void draw(std::span<const Picture> pictures, ImDrawData& panels,
                    const DrawOptions& options) = 0;
  /// Whether draw() only begins a picture, to be shown by present() when finished.
  [[nodiscard]] virtual bool deferred() const { return false; }
  /// Shows the picture that draw() began; call before the next begin_frame().
  /// @param wait false: only if it is finished
  /// @return false if it is still being drawn
  virtual bool present(bool wait) { return static_cast<void>(wait), true; }
  /// The picture shown, as RGB rows from the top; call right after draw() or present().
  /// @param x, y from the top left corner [pixel]
  [[nodiscard]] virtual std::vector<std::uint8_t> pixels(int x, int y, int width, int height) = 0;
  /// Call after the font atlas was rebuilt for another pixel ratio.
  virtual void fonts_changed() = 0;
};

}  // namespace substep
