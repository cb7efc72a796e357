#include "app/render/gl_renderer.hpp"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/render/cover.hpp"
#include "app/render/fans.hpp"
#include "app/render/gl_objects.hpp"
#include "app/render/gl_pictures.hpp"
#include "app/render/quality.hpp"
#include "app/render/shaders.hpp"

namespace substep {
namespace {

// The part of a canvas at this scale that lies completely inside a part of the window.
PixelRect scaled(const PixelRect& r, double scale) {
  const int x = static_cast<int>(std::ceil(scale * r.x));
  const int y = static_cast<int>(std::ceil(scale * r.y));
  const int right = static_cast<int>(std::floor(scale * (r.x + r.width)));
  const int bottom = static_cast<int>(std::floor(scale * (r.y + r.height)));
  return {x, y, std::max(0, right - x), std::max(0, bottom - y)};
}

class GlRenderer final : public Renderer {
 public:
  GlRenderer() = default;
  ~GlRenderer() override {
    glDeleteVertexArrays(1, &empty_array_);
    ImGui_ImplOpenGL3_Shutdown();
  }

  bool build(std::string_view draws, bool may_defer, std::string& error);
  void begin_frame() override {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::GetIO().Fonts->ClearTexData();  // uploaded; rebuilt on demand
  }
  void draw(std::span<const Picture> pictures, ImDrawData& panels,
            const DrawOptions& options) override;
  [[nodiscard]] bool deferred() const override { return deferred_; }
  bool present(bool wait) override;
  std::vector<std::uint8_t> pixels(int x, int y, int width, int height) override;
  void fonts_changed() override { ImGui_ImplOpenGL3_DestroyFontsTexture(); }

 private:
  void paint(std::span<const Picture> pictures);
  // Parts that are not shown, in pixels of the current canvas.
  [[nodiscard]] std::vector<PixelRect> hidden() const;
  void show_canvas() const;
  [[nodiscard]] Quality finest(std::span<const Picture> pictures) const;

  PicturePainter painter_;
  gl::Canvas canvas_;
  gl::Fence painted_;  // after the calls that paint the canvas, if deferred
  gl::Program texture_;
  GLuint empty_array_ = 0;
  std::vector<Picture> drawn_;        // on the canvas
  Panels covers_;                     // parts of the canvas are not drawn
  PixelRect window_;                  // its frame buffer
  PixelRect part_;                    // of it, to be drawn by present()
  bool incomplete_ = false;           // only a part of the canvas was painted
  Quality quality_ = Quality::kFine;  // of the canvas
  bool software_ = false;             // software renderer
  bool deferred_ = false;
  ImDrawData* panels_ = nullptr;  // to be drawn by present() over the canvas
  int unchanged_ = 0;             // frames since the pictures changed
};

bool GlRenderer::build(std::string_view draws, bool may_defer, std::string& error) {
  if (!ImGui_ImplOpenGL3_Init(nullptr)) {
    error = "Dear ImGui's OpenGL back end did not start";
    return false;
  }
  const std::string header = glsl::kHeader;
  glGenVertexArrays(1, &empty_array_);
  software_ = is_software(draws.empty() ? gl::renderer_name() : std::string(draws));
  deferred_ = may_defer && software_;
  const bool ok =
      texture_.build(header + glsl::kTextureVertex, header + glsl::kTextureFragment, error);
  return painter_.build(error) && ok;
}

std::vector<PixelRect> GlRenderer::hidden() const {
  std::vector<PixelRect> parts;
  for (const PixelRect& r :
       part_ == window_ ? covers_.interiors : uncovered(window_, {&part_, 1})) {
    parts.push_back(scaled(r, grain_of(quality_).scale));
  }
  return parts;
}

Quality GlRenderer::finest(std::span<const Picture> pictures) const {
  if (!software_) return Quality::kFine;
  std::size_t bodies = 0;
  for (const Picture& p : pictures) {
    bodies += p.boxes.size() + p.balls.size() + p.ghost_boxes.size() + p.ghost_balls.size();
  }
  return finest_in_software(bodies);
}

void GlRenderer::paint(std::span<const Picture> pictures) {
  const Grain grain = grain_of(quality_);
  const auto pixels = [&](int size) { return static_cast<int>(std::ceil(grain.scale * size)); };
  canvas_.fit(pixels(window_.width), pixels(window_.height), grain.samples);
  painter_.paint(pictures, quality_,
                 {canvas_.frame_buffer(), pixels(window_.width), pixels(window_.height)}, hidden());
  canvas_.resolve();
}

// Draws the canvas where panels do not hide it. With a software renderer this is faster than a
// blit.
void GlRenderer::show_canvas() const {
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glViewport(0, 0, window_.width, window_.height);
  texture_.use();
  texture_.set("picture", 0);
  canvas_.bind_texture();
  glBindVertexArray(empty_array_);
  for (const PixelRect& r : uncovered(part_, covers_.interiors)) {
    glScissor(r.x, window_.height - r.y - r.height, r.width, r.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
}

void GlRenderer::draw(std::span<const Picture> pictures, ImDrawData& panels,
                      const DrawOptions& options) {
  const PixelRect window{0, 0, options.width, options.height};
  const bool fits = window == window_;
  const bool same =
      fits && std::equal(pictures.begin(), pictures.end(), drawn_.begin(), drawn_.end());
  unchanged_ = same ? unchanged_ + 1 : 0;
  // While the mouse orbits the view, single frames may be unchanged.
  const Quality quality =
      std::min(unchanged_ < 2 ? options.moving : Quality::kFine, finest(pictures));
  Panels covers = panels_over_picture();
  const bool as_before = fits && covers == covers_;
  const bool partly = deferred_ && !options.whole && as_before;
  covers_ = std::move(covers);
  window_ = window;
  part_ = partly ? largest_uncovered(window, covers_.bounds) : window;
  if (!same || quality > quality_ || !as_before || (incomplete_ && !partly)) {
    quality_ = quality;
    paint(pictures);
    drawn_.assign(pictures.begin(), pictures.end());
    incomplete_ = partly;
  }
  if (partly) keep_within(part_, panels);
  if (software_) slice_fans(panels);
  panels_ = &panels;
  if (deferred_) {
    painted_.set();
  } else {
    present(true);
  }
}

bool GlRenderer::present(bool wait) {
  if (panels_ == nullptr) return true;
  if (!wait && !painted_.reached()) return false;
  show_canvas();
  ImGui_ImplOpenGL3_RenderDrawData(panels_);
  panels_ = nullptr;
  return true;
}

std::vector<std::uint8_t> GlRenderer::pixels(int x, int y, int width, int height) {
  // WebGL reads RGBA only, with rows from the bottom.
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  std::vector<std::uint8_t> rgba(4 * w * h);
  glReadPixels(x, window_.height - y - height, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
               rgba.data());
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * w * h);
  for (std::size_t row = h; row-- > 0;) {
    for (std::size_t column = 0; column < w; ++column) {
      const std::uint8_t* pixel = &rgba[4 * (row * w + column)];
      rgb.insert(rgb.end(), pixel, pixel + 3);
    }
  }
  return rgb;
}

}  // namespace

std::unique_ptr<Renderer> make_gl_renderer(std::string& error, std::string_view draws,
                                           bool may_defer) {
  auto renderer = std::make_unique<GlRenderer>();
  if (!renderer->build(draws, may_defer, error)) return nullptr;
  return renderer;
}

}  // namespace substep
