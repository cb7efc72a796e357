#pragma once

#include "app/render/renderer.hpp"

namespace substep {

/// Draws nothing and records its arguments.
class NullRenderer final : public Renderer {
 public:
  void begin_frame() override { ++begun; }
  void draw(std::span<const Picture> p, ImDrawData&, const DrawOptions& o) override {
    ++drawn;
    options = o;
    pictures.assign(p.begin(), p.end());
    picture = pictures.front();
  }
  std::vector<std::uint8_t> pixels(int, int, int width, int height) override {
    return std::vector<std::uint8_t>(
        3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128);
  }
  void fonts_changed() override { ++fonts; }

  int begun = 0;
  int drawn = 0;
  int fonts = 0;
  DrawOptions options;
  Picture picture;  // the first
  std::vector<Picture> pictures;
};

}  // namespace substep
