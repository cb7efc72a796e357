#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "app/render/renderer.hpp"

namespace substep {

/// A renderer for the current OpenGL 3.3 or WebGL 2 context, or null.
/// @param error the reason if the result is null
/// @param draws name of the renderer; "": GL_RENDERER
/// @param may_defer with a software renderer, draw() only begins a picture: a browser, which reads
/// the window's frame buffer after each change, does not wait for it. This frame buffer keeps its
/// pixels then.
std::unique_ptr<Renderer> make_gl_renderer(std::string& error, std::string_view draws = "",
                                           bool may_defer = false);

}  // namespace substep
