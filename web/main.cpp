// The application in a page: entry points called by web/loader.mjs for start and drawing.

#include <emscripten.h>
#include <emscripten/heap.h>
#include <emscripten/html5.h>
#include <imgui.h>
#include <malloc.h>

#include <string>

#include "app/render/gl_renderer.hpp"
#include "app/render/quality.hpp"
#include "app/shell/arrangement.hpp"
#include "web/host.hpp"
#include "web/instance.hpp"

namespace substep::web {

std::unique_ptr<Instance> instance;

namespace {
EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
std::string renderer_name;

}  // namespace

}  // namespace substep::web

using substep::web::instance;

extern "C" {

/// Whether the renderer of this name is software: then the canvas must keep its pixels.
EMSCRIPTEN_KEEPALIVE int substep_is_software(const char* renderer) {
  return substep::is_software(renderer) ? 1 : 0;
}

/// Runs the first scene. @param context WebGL 2 context, as an Emscripten handle
/// @param renderer its name, or "" if the browser hides it
/// @param keeps whether data is stored between visits; false in an embedded article
/// @return "" or the reason for a failure
EMSCRIPTEN_KEEPALIVE const char* substep_start(int context, const char* renderer, int keeps) {
  static std::string error;
  substep::web::context = context;
  substep::web::renderer_name = renderer;
  emscripten_webgl_make_context_current(context);
  instance = std::make_unique<substep::web::Instance>();
  auto gl = substep::make_gl_renderer(error, renderer, true);
  if (!gl) return error.c_str();
  substep::Library library("/scenes");
  if (library.scenes().empty()) return "the page contains no scenes";
  substep::add_exam(library);
  instance->app = std::make_unique<substep::App>(std::move(library), std::move(gl));
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
  auto renderer = substep::make_gl_renderer(error, substep::web::renderer_name, true);
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
/// @param whole 0: without a graphics card, panels may keep what they showed
EMSCRIPTEN_KEEPALIVE void substep_frame(double dt, int whole) {
  ImGui::GetIO().DeltaTime = static_cast<float>(dt > 1e-4 ? dt : 1e-4);
  if (instance->pinching) instance->app->hand.moved = true;
  substep::frame(*instance->app, dt, whole != 0);
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
