#include "app/render/gl_pictures.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/render/shaders.hpp"

namespace substep {

using Eigen::Matrix4f;
using Eigen::Vector3f;

namespace {

constexpr std::array<Grain, 4> kGrains{{{0.5, 1, 384, 1.0F, 2.0, 6000, false},
                                        {2.0 / 3.0, 1, 640, 1.0F, 2.0, 15000, true},
                                        {1.0, 1, 1536, 1.0F, 1.0, 60000, true},
                                        {1.0, 4, 1536, 4.0F, 0.5, 100000, true}}};

// Clears the depth of hidden parts to the nearest value, so that nothing is drawn there.
void leave_out(std::span<const PixelRect> hidden, int height) {
  constexpr float kNearest = 0.0F;
  for (const PixelRect& r : hidden) {
    glScissor(r.x, height - r.y - r.height, r.width, r.height);
    glClearBufferfv(GL_DEPTH, 0, &kNearest);
  }
}

// The scissor test removes everything outside the picture's part of the window.
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

}  // namespace

Grain grain_of(Quality quality) { return kGrains.at(static_cast<std::size_t>(quality)); }

PicturePainter::~PicturePainter() {
  glDeleteVertexArrays(1, &empty_array_);
  glDeleteVertexArrays(1, &contact_array_);
  glDeleteVertexArrays(1, &ribbon_array_);
}

bool PicturePainter::build(std::string& error) {
  const std::string header = glsl::kHeader;
  bool ok = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string fragment = header + (i == 1 ? glsl::kRough : "");
    ok &= background_[i].build(header + glsl::kBackgroundVertex,
                               fragment + glsl::kBackgroundFragment, error);
    ok &= body_[i].build(header + glsl::kBodyVertex,
                         fragment + glsl::kShadowFunction + glsl::kBodyFragment, error);
    ok &= ground_[i].build(header + glsl::kGroundVertex,
                           fragment + glsl::kShadowFunction + glsl::kGroundFragment, error);
  }
  ok &= shadow_.build(header + glsl::kBodyVertex, header + glsl::kShadowFragment, error);
  ok &= contact_.build(header + glsl::kContactVertex, header + glsl::kContactFragment, error);
  ok &= ribbon_.build(header + glsl::kRibbonVertex, header + glsl::kRibbonFragment, error);
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
  glGenVertexArrays(1, &contact_array_);
  glBindVertexArray(contact_array_);
  contact_instances_.bind();
  constexpr std::array<std::size_t, 3> kFields{
      offsetof(SoftShadow, centre), offsetof(SoftShadow, along), offsetof(SoftShadow, half_u)};
  for (GLuint i = 0; i < kFields.size(); ++i) {
    glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, sizeof(SoftShadow), gl::at(kFields[i]));
    glEnableVertexAttribArray(i);
    glVertexAttribDivisor(i, 1);
  }
  glBindVertexArray(0);
  return ok;
}

Matrix4f PicturePainter::light_matrix(const Picture& picture) const {
  const Vector3f back = picture.to_light.normalized();
  const Vector3f x = Vector3f::UnitZ().cross(back).normalized();
  const Vector3f y = back.cross(x);
  const float radius = std::max(picture.focus_radius, 0.1F);
  // The centre moves by whole texels to keep shadow edges stable.
  const float texel = 2.0F * radius / static_cast<float>(shadow_map_.size());
  const Vector3f focus = picture.focus;
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

void PicturePainter::upload(std::span<const Instance> boxes, std::span<const Instance> balls,
                            const Picture& picture, const Target& target) {
  bodies_.choose(boxes, balls,
                 {&picture, target.width, target.height, grain_.tolerance, grain_.vertices});
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i].upload(bodies_.boxes[i]);
  for (std::size_t i = 0; i < balls_.size(); ++i) balls_[i].upload(bodies_.balls[i]);
}

void PicturePainter::draw_meshes(const gl::Program& program) const {
  for (const gl::BodyMesh& mesh : boxes_) mesh.draw(program);
  for (const gl::BodyMesh& mesh : balls_) mesh.draw(program);
}

void PicturePainter::draw_shadows(const Matrix4f& light) {
  shadow_map_.bind_target();
  glViewport(0, 0, shadow_map_.size(), shadow_map_.size());
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 4.0F);
  shadow_.use();
  shadow_.set_matrix("view_projection", light.data());
  shadow_.set_matrix("world_to_shadow", light.data());
  draw_meshes(shadow_);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void PicturePainter::use_in_light(const gl::Program& program, const Picture& picture,
                                  const Matrix4f& light) const {
  program.use();
  program.set_matrix("view_projection", picture.view_projection.data());
  program.set_matrix("world_to_shadow", light.data());
  program.set("shadow_map", 0);
  program.set("shadow_taps", grain_.taps);
  program.set("shadow_texel", 1.0F / static_cast<float>(shadow_map_.size()));
}

void PicturePainter::draw_bodies(const Picture& picture, const Matrix4f& light) {
  const auto linear = [](const Color& c) {
    return std::array<float, 3>{c.r * c.r, c.g * c.g, c.b * c.b};
  };
  // Hemisphere light: sky from above, floor from below, both in the scene's own tint.
  std::array<float, 3> sky = linear(picture.background_top);
  std::array<float, 3> below = linear(picture.background_bottom);
  for (std::size_t i = 0; i < 3; ++i) {
    sky[i] = 0.82F + 0.35F * sky[i];
    below[i] = 0.34F + 0.35F * below[i];
  }
  const gl::Program& program = body_.at(rough_);
  use_in_light(program, picture, light);
  program.set3("eye", picture.eye.data());
  program.set3("to_light", picture.to_light.data());
  program.set("ambient", picture.ambient);
  program.set3("sky", sky.data());
  program.set3("floor_light", below.data());
  const Vector3f normal = picture.ground.normal.normalized();
  const std::array<float, 4> plane{normal.x(), normal.y(), normal.z(),
                                   -normal.dot(picture.ground.origin)};
  program.set4("floor_plane", plane.data());
  program.set("floor_reach", picture.ground.reach);
  program.set("floor_hides", picture.ground.solid ? picture.contact : 0.0F);
  draw_meshes(program);
}

// Call after draw_bodies; uses the same lighting. Ghosts are pushed back slightly, so that they do
// not show through a body in the same place.
void PicturePainter::draw_ghosts(const Picture& picture, const Target& target) {
  if (picture.ghost_boxes.empty() && picture.ghost_balls.empty()) return;
  upload(picture.ghost_boxes, picture.ghost_balls, picture, target);
  glEnable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.0F, 8.0F);
  glDepthMask(GL_TRUE);  // only the nearest face of a ghost is visible
  body_.at(rough_).use();
  draw_meshes(body_.at(rough_));
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CULL_FACE);
}

void PicturePainter::draw_ground(const Picture& picture, const Matrix4f& light) {
  const Ground& ground = picture.ground;
  // The grid is fixed in the world.
  const Vector3f normal = ground.normal.normalized();
  const Vector3f u = ground.along.normalized();
  const Vector3f v = normal.cross(u);
  const Vector3f to_centre = ground.centre - ground.origin;
  const float along_u = to_centre.dot(u);
  const float along_v = to_centre.dot(v);
  const Vector3f centre = ground.origin + along_u * u + along_v * v;
  const gl::Program& program = ground_.at(rough_);
  use_in_light(program, picture, light);
  program.set3("origin", centre.data());
  program.set3("axis_u", u.data());
  program.set3("axis_v", v.data());
  program.set2("offset", along_u, along_v);
  program.set("fade", ground.fade);
  program.set("cell", ground.cell);
  program.set("shadow", picture.shadow);
  const std::array<float, 4> none{};
  program.set4("surface", ground.solid ? &picture.floor.r : none.data());
  program.set3("shade", &picture.shade.r);
  Color grid = picture.grid;
  if (ground.solid) grid.a *= 0.65F;  // the floor itself shows where it is
  program.set4("grid", &grid.r);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

// Call after draw_ground(): they darken it. Neither writes depth.
void PicturePainter::draw_contacts(const Picture& picture) {
  if (picture.contacts.empty() || !grain_.contacts) return;
  contact_instances_.upload(picture.contacts.data(), picture.contacts.size() * sizeof(SoftShadow));
  const Vector3f normal = picture.ground.normal.normalized();
  const Color& c = picture.shade;
  const std::array<float, 4> shade{c.r, c.g, c.b, picture.contact};
  contact_.use();
  contact_.set_matrix("view_projection", picture.view_projection.data());
  contact_.set3("normal", normal.data());
  contact_.set4("shade", shade.data());
  glBindVertexArray(contact_array_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(picture.contacts.size()));
}

void PicturePainter::draw_ribbons(const Picture& picture) {
  if (picture.ribbons.empty()) return;
  ribbon_vertices_.upload(picture.ribbons.data(), picture.ribbons.size() * sizeof(RibbonVertex));
  ribbon_.use();
  ribbon_.set_matrix("view_projection", picture.view_projection.data());
  glBindVertexArray(ribbon_array_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(picture.ribbons.size()));
}

void PicturePainter::paint(std::span<const Picture> pictures, Quality quality, const Target& target,
                           std::span<const PixelRect> hidden) {
  grain_ = grain_of(quality);
  rough_ = quality <= Quality::kCoarse ? 1 : 0;
  shadow_map_.fit(grain_.shadow_size);
  for (const Picture& picture : pictures) draw_picture(picture, target, hidden);
}

// Drawn behind everything else.
void PicturePainter::draw_background(const Picture& picture) {
  glDepthFunc(GL_LEQUAL);
  const gl::Program& program = background_.at(rough_);
  program.use();
  program.set3("top", &picture.background_top.r);
  program.set3("bottom", &picture.background_bottom.r);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

void PicturePainter::draw_picture(const Picture& picture, const Target& target,
                                  std::span<const PixelRect> hidden) {
  const Matrix4f light = light_matrix(picture);
  upload(picture.boxes, picture.balls, picture, target);

  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glEnable(GL_CULL_FACE);
  draw_shadows(light);
  shadow_map_.bind_texture();

  glBindFramebuffer(GL_FRAMEBUFFER, target.frame_buffer);
  glViewport(0, 0, target.width, target.height);
  limit_to(picture.part, target.width, target.height);
  glClear(GL_DEPTH_BUFFER_BIT);
  leave_out(hidden, target.height);
  limit_to(picture.part, target.width, target.height);
  draw_bodies(picture, light);
  draw_background(picture);

  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  draw_ground(picture, light);
  draw_contacts(picture);
  draw_ribbons(picture);
  draw_ghosts(picture, target);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace substep
