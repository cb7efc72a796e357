#include "app/render/gl_renderer.hpp"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/render/gl_objects.hpp"
#include "app/render/gl_pictures.hpp"
#include "app/render/picture_changes.hpp"
#include "app/render/shaders.hpp"
#include "app/render/tiles.hpp"

namespace substep {
namespace {

// The part of a canvas at this scale that lies within a part of the window for sure.
PixelRect scaled(const PixelRect& r, double scale) {
  const int x = static_cast<int>(std::ceil(scale * r.x));
  const int y = static_cast<int>(std::ceil(scale * r.y));
  const int right = static_cast<int>(std::floor(scale * (r.x + r.width)));
  const int bottom = static_cast<int>(std::floor(scale * (r.y + r.height)));
  return {x, y, std::max(0, right - x), std::max(0, bottom - y)};
}

class GlRenderer final : public Renderer {
 public:
  explicit GlRenderer(std::unique_ptr<Backdrop> backdrop) : backdrop_(std::move(backdrop)) {}
  ~GlRenderer() override {
    if (behind_) give_up_backdrop();
    glDeleteVertexArrays(1, &empty_array_);
    ImGui_ImplOpenGL3_Shutdown();
  }

  bool build(std::string& error);
  void begin_frame() override {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::GetIO().Fonts->ClearTexData();  // the graphics have it; made again where it is wanted
  }
  void draw(std::span<const Picture> pictures, std::span<const Layer> layers,
            const DrawOptions& options) override;
  std::vector<std::uint8_t> pixels(int x, int y, int width, int height) override;
  void fonts_changed() override { ImGui_ImplOpenGL3_DestroyFontsTexture(); }

 private:
  void give_up_backdrop();
  bool paint_behind(std::span<const Picture> pictures, std::span<const Part> parts);
  void paint(std::span<const Picture> pictures, std::span<const Part> parts);
  // What panels cover, on a canvas of the present quality.
  [[nodiscard]] std::vector<PixelRect> hidden() const;
  // A canvas for the window; its frame buffer is the default one.
  [[nodiscard]] Target target_of(const Grain& grain) const;
  void begin_textures() const;
  void show_canvas() const;
  void show_kept(const gl::Copy& kept, const PixelRect& area) const;
  void draw_layers(std::span<const Layer> layers);
  void draw_changes(std::span<const Layer> layers);

  PicturePainter painter_;
  gl::Canvas canvas_;
  gl::Program texture_;
  GLuint empty_array_ = 0;
  std::vector<Picture> drawn_;        // what is on the canvas or the backdrop
  std::vector<PixelRect> covered_;    // and what is not, since it lies under panels
  Quality quality_ = Quality::kFine;  // of what is drawn
  int unchanged_ = 0;                 // frames since it changed
  std::map<ImGuiID, gl::Copy> kept_;  // panels as they were drawn last
  int width_ = 0;                     // of the window's frame buffer [pixel]
  int height_ = 0;

  std::unique_ptr<Backdrop> backdrop_;      // null: none
  std::unique_ptr<PicturePainter> behind_;  // in its context, once it is used
  bool apart_ = false;                      // the picture is on the backdrop, not on the window
  TileRecord record_;                       // what is on the window then
};

bool GlRenderer::build(std::string& error) {
  if (!ImGui_ImplOpenGL3_Init(nullptr)) {
    error = "Dear ImGui's OpenGL back end did not start";
    return false;
  }
  const std::string header = glsl::kHeader;
  glGenVertexArrays(1, &empty_array_);
  const bool ok =
      texture_.build(header + glsl::kTextureVertex, header + glsl::kTextureFragment, error);
  return painter_.build(error) && ok;
}

std::vector<PixelRect> GlRenderer::hidden() const {
  std::vector<PixelRect> parts;
  for (const PixelRect& r : covered_) parts.push_back(scaled(r, grain_of(quality_).scale));
  return parts;
}

Target GlRenderer::target_of(const Grain& grain) const {
  return {0, static_cast<int>(std::ceil(grain.scale * width_)),
          static_cast<int>(std::ceil(grain.scale * height_))};
}

// @return whether it is seen there
bool GlRenderer::paint_behind(std::span<const Picture> pictures, std::span<const Part> parts) {
  const Target target = target_of(grain_of(quality_));
  bool seen = backdrop_->begin(target.width, target.height);
  if (seen && !behind_) {
    behind_ = std::make_unique<PicturePainter>();
    std::string error;  // the window's own tells, and was built
    seen = behind_->build(error);
  }
  if (seen) behind_->paint(pictures, parts, quality_, target, hidden());
  backdrop_->end();
  if (!seen) give_up_backdrop();
  return seen;
}

// Its objects go in the context that they belong to.
void GlRenderer::give_up_backdrop() {
  backdrop_->begin(1, 1);
  behind_.reset();
  backdrop_->end();
  backdrop_.reset();
}

void GlRenderer::paint(std::span<const Picture> pictures, std::span<const Part> parts) {
  const Grain grain = grain_of(quality_);
  Target target = target_of(grain);
  canvas_.fit(target.width, target.height, grain.samples);
  target.frame_buffer = canvas_.frame_buffer();
  painter_.paint(pictures, parts, quality_, target, hidden());
  canvas_.resolve();
}

// What is on a texture is put on the window by drawing it: to enlarge by copying takes a software
// renderer longer.
void GlRenderer::begin_textures() const {
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  texture_.use();
  texture_.set("picture", 0);
  glBindVertexArray(empty_array_);
}

// The canvas over the window, where it is seen.
void GlRenderer::show_canvas() const {
  begin_textures();
  glViewport(0, 0, width_, height_);
  canvas_.bind_texture();
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& part : uncovered({0, 0, width_, height_}, covered_)) {
    glScissor(part.x, height_ - part.y - part.height, part.width, part.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
}

void GlRenderer::show_kept(const gl::Copy& kept, const PixelRect& area) const {
  begin_textures();
  glDisable(GL_SCISSOR_TEST);
  glViewport(area.x, height_ - area.y - area.height, area.width, area.height);
  kept.bind_texture();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void GlRenderer::draw_layers(std::span<const Layer> layers) {
  std::erase_if(kept_, [&](const auto& kept) {
    return std::none_of(layers.begin(), layers.end(), [&](const Layer& layer) {
      return layer.id == kept.first && layer.showing != Showing::kDraw;
    });
  });
  ImDrawData batch;
  const auto flush = [&batch] {
    if (batch.CmdListsCount > 0) ImGui_ImplOpenGL3_RenderDrawData(&batch);
    batch.CmdLists.clear();
    batch.CmdListsCount = 0;
  };
  for (const Layer& layer : layers) {
    const PixelRect& r = layer.area;
    const int bottom = height_ - r.y - r.height;
    const auto kept = kept_.find(layer.id);
    if (layer.showing == Showing::kKept && kept != kept_.end()) {
      flush();
      show_kept(kept->second, r);
      continue;
    }
    if (batch.CmdListsCount == 0)
      batch = layer.lists;
    else
      for (ImDrawList* list : layer.lists.CmdLists) batch.CmdLists.push_back(list);
    batch.CmdListsCount = batch.CmdLists.Size;
    if (layer.showing == Showing::kDraw) continue;
    flush();
    kept_[layer.id].take(r.x, bottom, r.width, r.height);
  }
  flush();
}

// On a window that keeps its pixels and that the backdrop shines through.
void GlRenderer::draw_changes(std::span<const Layer> layers) {
  const std::vector<PixelRect> parts = record_.changes(width_, height_, layers);
  if (parts.empty()) return;
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& part : parts) {
    glScissor(part.x, height_ - part.y - part.height, part.width, part.height);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glDisable(GL_SCISSOR_TEST);
  ImDrawData changed = limited_to(parts, layers);
  ImGui_ImplOpenGL3_RenderDrawData(&changed);
}

void GlRenderer::draw(std::span<const Picture> pictures, std::span<const Layer> layers,
                      const DrawOptions& options) {
  const bool fits = options.width == width_ && options.height == height_;
  const bool same =
      fits && std::equal(pictures.begin(), pictures.end(), drawn_.begin(), drawn_.end());
  unchanged_ = same ? unchanged_ + 1 : 0;
  // Between two events of a mouse that turns the view there is a frame without a change.
  const Quality quality = unchanged_ < 2 ? options.moving : Quality::kFine;
  std::vector<PixelRect> covered;
  for (const Layer& layer : layers) {
    if (layer.covers.width > 0 && layer.covers.height > 0) covered.push_back(layer.covers);
  }
  const bool apart = backdrop_ && quality <= Quality::kCoarse && !options.read_back;
  // What was drawn can stay, or most of it.
  const bool stays = fits && covered == covered_ && apart == apart_;
  if (!(stays && same && quality <= quality_)) {
    std::vector<Part> whole;
    for (const Picture& picture : pictures) whole.push_back(picture.part);
    const bool most = stays && quality == quality_ && pictures.size() == drawn_.size();
    const std::vector<Part> parts = most ? changed_parts(drawn_, pictures) : whole;
    covered_ = std::move(covered);
    quality_ = quality;
    width_ = options.width;
    height_ = options.height;
    const bool was_apart = std::exchange(apart_, apart && paint_behind(pictures, parts));
    if (!apart_) paint(pictures, apart ? whole : parts);
    if (apart_ != was_apart) {
      record_.forget();
      kept_.clear();  // the round corners of a kept panel show what lies behind it
    }
    drawn_.assign(pictures.begin(), pictures.end());
  }
  if (apart_) {
    draw_changes(layers);
    return;
  }
  glDisable(GL_SCISSOR_TEST);
  show_canvas();
  draw_layers(layers);
}

std::vector<std::uint8_t> GlRenderer::pixels(int x, int y, int width, int height) {
  // WebGL reads RGBA only, and rows come from the bottom.
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  std::vector<std::uint8_t> rgba(4 * w * h);
  glReadPixels(x, height_ - y - height, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
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

std::unique_ptr<Renderer> make_gl_renderer(std::string& error, std::unique_ptr<Backdrop> backdrop) {
  auto renderer = std::make_unique<GlRenderer>(std::move(backdrop));
  if (!renderer->build(error)) return nullptr;
  return renderer;
}

}  // namespace substep
