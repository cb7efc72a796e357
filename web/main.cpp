// The application in a page: entry points called by web/loader.mjs for start and drawing.

#include <GLES3/gl3.h>
#include <emscripten.h>
#include <emscripten/heap.h>
#include <emscripten/html5.h>
#include <imgui.h>
#include <malloc.h>

#include <string>

#include "app/render/gl_renderer.hpp"
#include "app/shell/arrangement.hpp"
#include "web/host.hpp"
#include "web/instance.hpp"

namespace substep::web {

std::unique_ptr<Instance> instance;

namespace {
EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;

// Browsers provide the name only by an extension; "" without it.
std::string renderer_name() {
  constexpr GLenum kUnmaskedRenderer = 0x9246;
  if (!emscripten_webgl_enable_extension(context, "WEBGL_debug_renderer_info")) return "";
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): characters
  const auto* name = reinterpret_cast<const char*>(glGetString(kUnmaskedRenderer));
  return name != nullptr ? name : "";
}

}  // namespace

}  // namespace substep::web

using substep::web::instance;

extern "C" {

/// Runs the first scene. @param context WebGL 2 context, as an Emscripten handle
/// @param keeps whether data is stored between visits; false in an embedded article
/// @return "" or the reason for a failure
EMSCRIPTEN_KEEPALIVE const char* substep_start(int context, int keeps) {
  static std::string error;
  substep::web::context = context;
  emscripten_webgl_make_context_current(context);
  instance = std::make_unique<substep::web::Instance>();
  auto renderer = substep::make_gl_renderer(error, substep::web::renderer_name(), true);
  if (!renderer) return error.c_str();
  substep::Library library("/scenes");
  if (library.scenes().empty()) return "the page contains no scenes";
  substep::add_exam(library);
  instance->app = std::make_unique<substep::App>(std::move(library), std::move(renderer));
  instance->app->host = substep::web::page_host();
  if (keeps == 0) {
    instance->app->host.remember = nullptr;
    instance->app->host.recall = nullptr;
  }
  instance->app->recall_scenes();
  recall_arrangement(*instance->app);
  substep::web::use_page_clipboard();
  return "";
}

/// All objects of the context are lost. They are deleted while it is lost; later their names would
/// refer to objects of the restored context.
EMSCRIPTEN_KEEPALIVE void substep_context_lost() { instance->app->renderer.reset(); }

EMSCRIPTEN_KEEPALIVE const char* substep_context_restored() {
  static std::string error;
  error.clear();
  emscripten_webgl_make_context_current(substep::web::context);
  auto renderer = substep::make_gl_renderer(error, substep::web::renderer_name(), true);
  if (!renderer) return error.c_str();
  instance->app->renderer = std::move(renderer);
  return "";
}

/// The size of the canvas in CSS pixels, and its pixel ratio.
EMSCRIPTEN_KEEPALIVE void substep_resize(float width, float height, float ratio) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {width, height};
  io.DisplayFramebufferScale = {ratio, ratio};
}

/// Whether a frame must be shown by substep_present after software rendering.
EMSCRIPTEN_KEEPALIVE int substep_deferred() { return instance->app->renderer->deferred() ? 1 : 0; }

/// Shows the frame that substep_frame began. @param wait 0: only if it is finished
/// @return 0 if it is still being drawn
EMSCRIPTEN_KEEPALIVE int substep_present(int wait) {
  return instance->app->renderer->present(wait != 0) ? 1 : 0;
}

/// Draws one frame, or begins to. @param dt wall time since the last one [s]
EMSCRIPTEN_KEEPALIVE void substep_frame(double dt) {
  ImGui::GetIO().DeltaTime = static_cast<float>(dt > 1e-4 ? dt : 1e-4);
  if (instance->pinching) instance->app->hand.moved = true;
  substep::frame(*instance->app, dt);
}

/// The mouse cursor to show: 0 arrow, 1 hand, 2 text.
EMSCRIPTEN_KEEPALIVE int substep_cursor() {
  switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_Hand:
      return 1;
    case ImGuiMouseCursor_TextInput:
      return 2;
    default:
      return 0;
  }
}

/// Used and total bytes of the heap, as JSON.
EMSCRIPTEN_KEEPALIVE const char* substep_memory() {
  static std::string text;
  text = "{\"used\":" + std::to_string(mallinfo().uordblks) +
         ",\"heap\":" + std::to_string(emscripten_get_heap_size()) + "}";
  return text.c_str();
}

}  // extern "C"

int main() { return 0; }
