#pragma once

#include "app/render/renderer.hpp"

namespace substep {

/// Draws nothing and remembers what it was given: for tests.
class NullRenderer final : public Renderer {
 public:
  void begin_frame() override { ++begun; }
  void draw(const Picture& p, const ImDrawData&, int, int) override {
    ++drawn;
    picture = p;
  }
  void fonts_changed() override { ++fonts; }

  int begun = 0;
  int drawn = 0;
  int fonts = 0;
  Picture picture;
};

}  // namespace substep
