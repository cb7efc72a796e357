#include "web/backdrop.hpp"

#include <emscripten.h>
#include <emscripten/html5.h>

#include <cstdlib>

// The bodies are JavaScript.
// clang-format off
EM_JS(int, host_backdrop, (int width, int height), {
  return Module["host"].backdrop(width, height);
})
EM_JS(int, host_has_backdrop, (), { return Module["host"].backdrop ? 1 : 0; })
// clang-format on

namespace substep::web {
namespace {

class PageBackdrop final : public Backdrop {
 public:
  explicit PageBackdrop(int window) : window_(window) {}

  bool begin(int width, int height) override {
    const int context = host_backdrop(width, height);
    if (context != 0) emscripten_webgl_make_context_current(std::abs(context));
    return context > 0;
  }
  void end() override { emscripten_webgl_make_context_current(window_); }

 private:
  int window_;
};

}  // namespace

std::unique_ptr<Backdrop> page_backdrop(int window) {
  return host_has_backdrop() != 0 ? std::make_unique<PageBackdrop>(window) : nullptr;
}

}  // namespace substep::web
