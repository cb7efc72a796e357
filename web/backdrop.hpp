#pragma once

#include <memory>

#include "app/render/gl_renderer.hpp"

namespace substep::web {

/// The canvas behind the page's own. @param window the context of that one, as Emscripten counts
/// @return null where the page has none: where a graphics card draws, one canvas is quicker
std::unique_ptr<Backdrop> page_backdrop(int window);

}  // namespace substep::web
