#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "app/render/renderer.hpp"

namespace substep {

/// A renderer for the OpenGL 3.3 or WebGL 2 context that is current now.
/// @param error says why there is none, where null comes back
/// @param draws what draws, by name; "": as OpenGL says
/// @param may_defer with a software renderer, draw() only begins a picture: a browser, which reads
///   the window's frame buffer after each change, does not wait for it
std::unique_ptr<Renderer> make_gl_renderer(std::string& error, std::string_view draws = "",
                                           bool may_defer = false);

}  // namespace substep
