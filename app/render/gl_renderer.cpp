#include "app/render/gl_renderer.hpp"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/render/gl_objects.hpp"
#include "app/render/shaders.hpp"

namespace substep {
namespace {

using Eigen::Matrix4f;
using Eigen::Vector3f;

// What a quality is made of.
struct Grain {
  double scale;     // of the window's width and height [-]
  int samples;      // per pixel
  int shadow_size;  // [texel]
  float taps;       // of the shadow map per pixel
};
constexpr std::array<Grain, 4> kGrains{
    {{0.5, 1, 384, 1.0F}, {2.0 / 3.0, 1, 640, 1.0F}, {1.0, 1, 1536, 1.0F}, {1.0, 4, 1536, 4.0F}}};

// What bodies are made of.
struct Meshes {
  Meshes(int box_segments, const gl::StreamBuffer& boxes, int ball_segments,
         const gl::StreamBuffer& balls)
      : box(box_segments, true, boxes), ball(ball_segments, false, balls) {}
  gl::RoundedBox box;
  gl::RoundedBox ball;
};

Vector3f vector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

class GlRenderer final : public Renderer {
 public:
  ~GlRenderer() override {
    glDeleteVertexArrays(1, &empty_array_);
    glDeleteVertexArrays(1, &ribbon_array_);
    ImGui_ImplOpenGL3_Shutdown();
  }

  bool build(std::string& error);
  void begin_frame() override { ImGui_ImplOpenGL3_NewFrame(); }
  void draw(std::span<const Picture> pictures, std::span<const Layer> layers, int width, int height,
            Quality moving) override;
  std::vector<std::uint8_t> pixels(int x, int y, int width, int height) override;
  void fonts_changed() override { ImGui_ImplOpenGL3_DestroyFontsTexture(); }

 private:
  // World to the light's clip space: a box around the focus, seen from far along the light.
  [[nodiscard]] Matrix4f light_matrix(const Picture& picture) const;
  void draw_pictures(std::span<const Picture> pictures, Quality quality, int width, int height);
  void draw_picture(const Picture& picture, int width, int height);
  void leave_out_covered(double scale, int height) const;
  void draw_background(const Picture& picture);
  void draw_shadows(const Picture& picture, const Matrix4f& light);
  void draw_bodies(const Picture& picture, const Matrix4f& light);
  void draw_ghosts(const Picture& picture);
  void draw_ground(const Picture& picture, const Matrix4f& light);
  void draw_ribbons(const Picture& picture);
  void begin_textures() const;
  void show_canvas() const;
  void show_kept(const gl::Copy& kept, const PixelRect& area) const;
  void draw_layers(std::span<const Layer> layers);

  gl::StreamBuffer box_instances_;
  gl::StreamBuffer ball_instances_;
  gl::StreamBuffer ribbon_vertices_;
  Meshes fine_{3, box_instances_, 8, ball_instances_};
  Meshes coarse_{1, box_instances_, 3, ball_instances_};
  Meshes sketch_{1, box_instances_, 2, ball_instances_};
  Meshes outlines_{0, box_instances_, 2, ball_instances_};  // for shadows, which show no faces
  const Meshes* meshes_ = &fine_;
  const Meshes* shadow_meshes_ = &fine_;
  gl::ShadowMap shadow_map_;
  gl::Program background_;
  gl::Program body_;
  gl::Program shadow_;
  gl::Program ground_;
  gl::Program ribbon_;
  gl::Program texture_;
  GLuint empty_array_ = 0;
  GLuint ribbon_array_ = 0;
  gl::Canvas canvas_;
  float shadow_taps_ = 4.0F;
  std::vector<Picture> drawn_;        // what is on the canvas
  std::vector<PixelRect> covered_;    // and what is not, since it lies under panels
  std::map<ImGuiID, gl::Copy> kept_;  // panels as they were drawn last
  Quality quality_ = Quality::kFine;  // of it
  int unchanged_ = 0;                 // frames since it changed
  int width_ = 0;                     // of the frame buffer [pixel]
  int height_ = 0;
};

bool GlRenderer::build(std::string& error) {
  if (!ImGui_ImplOpenGL3_Init(nullptr)) {
    error = "Dear ImGui's OpenGL back end did not start";
    return false;
  }
  const std::string header = glsl::kHeader;
  const std::string receiving = header + glsl::kShadowFunction;
  bool ok = background_.build(header + glsl::kBackgroundVertex, header + glsl::kBackgroundFragment,
                              error);
  ok &= body_.build(header + glsl::kBodyVertex, receiving + glsl::kBodyFragment, error);
  ok &= shadow_.build(header + glsl::kBodyVertex, header + glsl::kShadowFragment, error);
  ok &= ground_.build(header + glsl::kGroundVertex, receiving + glsl::kGroundFragment, error);
  ok &= ribbon_.build(header + glsl::kRibbonVertex, header + glsl::kRibbonFragment, error);
  ok &= texture_.build(header + glsl::kTextureVertex, header + glsl::kTextureFragment, error);
  if (!shadow_map_.complete()) {
    error += "the frame buffer for shadows is not complete";
    ok = false;
  }
  glGenVertexArrays(1, &empty_array_);
  glGenVertexArrays(1, &ribbon_array_);
  glBindVertexArray(ribbon_array_);
  ribbon_vertices_.bind();
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(RibbonVertex), nullptr);
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(RibbonVertex),
                        gl::at(offsetof(RibbonVertex, color)));
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glBindVertexArray(0);
  return ok;
}

Matrix4f GlRenderer::light_matrix(const Picture& picture) const {
  const Vector3f back = vector(picture.to_light).normalized();
  const Vector3f x = Vector3f::UnitZ().cross(back).normalized();
  const Vector3f y = back.cross(x);
  const float radius = std::max(picture.focus_radius, 0.1F);
  // The middle moves by whole texels, or edges of shadows would crawl.
  const float texel = 2.0F * radius / static_cast<float>(shadow_map_.size());
  const Vector3f focus = vector(picture.focus);
  const auto snap = [texel](float v) { return std::floor(v / texel) * texel; };
  Matrix4f m = Matrix4f::Identity();
  m.block<1, 3>(0, 0) = x.transpose() / radius;
  m.block<1, 3>(1, 0) = y.transpose() / radius;
  m.block<1, 3>(2, 0) = -back.transpose() / (3.0F * radius);
  m(0, 3) = -snap(x.dot(focus)) / radius;
  m(1, 3) = -snap(y.dot(focus)) / radius;
  m(2, 3) = back.dot(focus) / (3.0F * radius);
  return m;
}

void GlRenderer::draw_shadows(const Picture& picture, const Matrix4f& light) {
  shadow_map_.bind_target();
  glViewport(0, 0, shadow_map_.size(), shadow_map_.size());
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 4.0F);
  shadow_.use();
  shadow_.set_matrix("view_projection", light.data());
  shadow_.set_matrix("world_to_shadow", light.data());
  shadow_meshes_->box.draw(static_cast<int>(picture.boxes.size()));
  shadow_meshes_->ball.draw(static_cast<int>(picture.balls.size()));
  glDisable(GL_POLYGON_OFFSET_FILL);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void GlRenderer::draw_bodies(const Picture& picture, const Matrix4f& light) {
  const auto linear = [](const Color& c) {
    return std::array<float, 3>{c.r * c.r, c.g * c.g, c.b * c.b};
  };
  // The sky lights from above, the floor from below, both with the room's own tint.
  std::array<float, 3> sky = linear(picture.background_top);
  std::array<float, 3> below = linear(picture.background_bottom);
  for (std::size_t i = 0; i < 3; ++i) {
    sky[i] = 0.82F + 0.35F * sky[i];
    below[i] = 0.34F + 0.35F * below[i];
  }
  body_.use();
  body_.set_matrix("view_projection", picture.view_projection.data());
  body_.set_matrix("world_to_shadow", light.data());
  body_.set("shadow_map", 0);
  body_.set("shadow_taps", shadow_taps_);
  body_.set("shadow_texel", 1.0F / static_cast<float>(shadow_map_.size()));
  body_.set3("eye", picture.eye.data());
  body_.set3("to_light", picture.to_light.data());
  body_.set("ambient", picture.ambient);
  body_.set3("sky", sky.data());
  body_.set3("floor_light", below.data());
  meshes_->box.draw(static_cast<int>(picture.boxes.size()));
  meshes_->ball.draw(static_cast<int>(picture.balls.size()));
}

// After draw_bodies, with its light. A little behind where they are, so that a ghost in the same
// place as its body does not show through it.
void GlRenderer::draw_ghosts(const Picture& picture) {
  if (picture.ghost_boxes.empty() && picture.ghost_balls.empty()) return;
  box_instances_.upload(picture.ghost_boxes.data(), picture.ghost_boxes.size() * sizeof(Instance));
  ball_instances_.upload(picture.ghost_balls.data(), picture.ghost_balls.size() * sizeof(Instance));
  glEnable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.0F, 8.0F);
  glDepthMask(GL_TRUE);  // only the nearest face of a ghost is seen
  body_.use();
  meshes_->box.draw(static_cast<int>(picture.ghost_boxes.size()));
  meshes_->ball.draw(static_cast<int>(picture.ghost_balls.size()));
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CULL_FACE);
}

void GlRenderer::draw_ground(const Picture& picture, const Matrix4f& light) {
  const Ground& ground = picture.ground;
  if (!ground.visible) return;
  // The quad is centred below the focus and the grid stays where it is in the world.
  const Vector3f normal = vector(ground.normal).normalized();
  const Vector3f u = vector(ground.along).normalized();
  const Vector3f v = normal.cross(u);
  const Vector3f to_focus = vector(picture.focus) - vector(ground.origin);
  const float along_u = to_focus.dot(u);
  const float along_v = to_focus.dot(v);
  const Vector3f centre = vector(ground.origin) + along_u * u + along_v * v;
  ground_.use();
  ground_.set_matrix("view_projection", picture.view_projection.data());
  ground_.set_matrix("world_to_shadow", light.data());
  ground_.set("shadow_map", 0);
  ground_.set("shadow_taps", shadow_taps_);
  ground_.set("shadow_texel", 1.0F / static_cast<float>(shadow_map_.size()));
  ground_.set3("origin", centre.data());
  ground_.set3("axis_u", u.data());
  ground_.set3("axis_v", v.data());
  ground_.set2("offset", along_u, along_v);
  ground_.set("fade", ground.fade);
  ground_.set("cell", ground.cell);
  ground_.set("shadow", picture.shadow);
  ground_.set("surface", 0.05F);
  ground_.set4("grid", &picture.grid.r);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void GlRenderer::draw_ribbons(const Picture& picture) {
  if (picture.ribbons.empty()) return;
  ribbon_vertices_.upload(picture.ribbons.data(), picture.ribbons.size() * sizeof(RibbonVertex));
  ribbon_.use();
  ribbon_.set_matrix("view_projection", picture.view_projection.data());
  glBindVertexArray(ribbon_array_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(picture.ribbons.size()));
}

// The graphics card cuts off what is not in the picture's part of the window.
void limit_to(const Part& part, int width, int height) {
  const auto pixel = [](float share, int size) {
    return static_cast<int>(std::lround(share * static_cast<float>(size)));
  };
  const int x = pixel(part.x, width);
  const int top = pixel(part.y, height);
  const int bottom = pixel(part.y + part.height, height);
  glScissor(x, height - bottom, pixel(part.x + part.width, width) - x, bottom - top);
  glEnable(GL_SCISSOR_TEST);
}

void GlRenderer::draw_pictures(std::span<const Picture> pictures, Quality quality, int width,
                               int height) {
  const Grain& grain = kGrains.at(static_cast<std::size_t>(quality));
  const int w = static_cast<int>(std::ceil(grain.scale * width));
  const int h = static_cast<int>(std::ceil(grain.scale * height));
  canvas_.fit(w, h, grain.samples);
  shadow_taps_ = grain.taps;
  shadow_map_.fit(grain.shadow_size);
  meshes_ = quality > Quality::kCoarse ? &fine_ : quality == Quality::kCoarse ? &coarse_ : &sketch_;
  shadow_meshes_ = quality > Quality::kCoarse ? &fine_ : &outlines_;
  for (const Picture& picture : pictures) draw_picture(picture, w, h);
  canvas_.resolve();
}

// What lies under panels is marked as nearer than anything. @param scale, height of the canvas
void GlRenderer::leave_out_covered(double scale, int height) const {
  constexpr float kNearest = 0.0F;
  for (const PixelRect& r : covered_) {
    const int x = static_cast<int>(std::ceil(scale * r.x));
    const int y = static_cast<int>(std::ceil(scale * r.y));
    const int right = static_cast<int>(std::floor(scale * (r.x + r.width)));
    const int bottom = static_cast<int>(std::floor(scale * (r.y + r.height)));
    glScissor(x, height - bottom, right - x, bottom - y);
    glClearBufferfv(GL_DEPTH, 0, &kNearest);
  }
}

// Behind everything.
void GlRenderer::draw_background(const Picture& picture) {
  glDepthFunc(GL_LEQUAL);
  background_.use();
  background_.set3("top", &picture.background_top.r);
  background_.set3("bottom", &picture.background_bottom.r);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

// @param width, height of the canvas [pixel]
void GlRenderer::draw_picture(const Picture& picture, int width, int height) {
  const Matrix4f light = light_matrix(picture);
  box_instances_.upload(picture.boxes.data(), picture.boxes.size() * sizeof(Instance));
  ball_instances_.upload(picture.balls.data(), picture.balls.size() * sizeof(Instance));

  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glEnable(GL_CULL_FACE);
  draw_shadows(picture, light);
  shadow_map_.bind_texture();

  canvas_.bind();
  limit_to(picture.part, width, height);
  glClear(GL_DEPTH_BUFFER_BIT);
  leave_out_covered(static_cast<double>(width) / width_, height);
  limit_to(picture.part, width, height);
  draw_bodies(picture, light);
  draw_background(picture);

  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  draw_ground(picture, light);
  draw_ribbons(picture);
  draw_ghosts(picture);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
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

void GlRenderer::draw(std::span<const Picture> pictures, std::span<const Layer> layers, int width,
                      int height, Quality moving) {
  const bool same = width == width_ && height == height_ &&
                    std::equal(pictures.begin(), pictures.end(), drawn_.begin(), drawn_.end());
  unchanged_ = same ? unchanged_ + 1 : 0;
  // Between two events of a mouse that turns the view there is a frame without a change.
  const Quality quality = unchanged_ < 2 ? moving : Quality::kFine;
  std::vector<PixelRect> covered;
  for (const Layer& layer : layers) {
    if (layer.covers.width > 0 && layer.covers.height > 0) covered.push_back(layer.covers);
  }
  if (!same || quality > quality_ || covered != covered_) {
    covered_ = std::move(covered);
    quality_ = quality;
    width_ = width;
    height_ = height;
    draw_pictures(pictures, quality, width, height);
    drawn_.assign(pictures.begin(), pictures.end());
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

std::unique_ptr<Renderer> make_gl_renderer(std::string& error) {
  auto renderer = std::make_unique<GlRenderer>();
  if (!renderer->build(error)) return nullptr;
  return renderer;
}

}  // namespace substep
