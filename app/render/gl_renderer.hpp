#pragma once

#include <memory>
#include <string>

#include "app/render/renderer.hpp"

namespace substep {

/// A surface of its own size and OpenGL context behind the window, which the window system enlarges
/// to the window's size and puts together with it: where a processor draws, that takes a third of
/// the time of doing both in OpenGL. The window is then one that can be seen through (colours
/// multiplied by coverage) and that keeps its pixels from frame to frame.
class Backdrop {
 public:
  virtual ~Backdrop() = default;

  /// Makes its context the current one until end(), with a frame buffer of this size [pixel].
  /// @return false where nothing that is drawn there will be seen, or will ever be again
  virtual bool begin(int width, int height) = 0;
  /// Makes the window's context current again.
  virtual void end() = 0;
};

/// A renderer for the OpenGL 3.3 or WebGL 2 context that is current now.
/// @param error says why there is none, where null comes back
/// @param backdrop null where there is none; it is used for what is drawn in a hurry
std::unique_ptr<Renderer> make_gl_renderer(std::string& error,
                                           std::unique_ptr<Backdrop> backdrop = nullptr);

}  // namespace substep
