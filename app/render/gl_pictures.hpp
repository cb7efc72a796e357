#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>

#include "app/render/cover.hpp"
#include "app/render/detail.hpp"
#include "app/render/gl_objects.hpp"
#include "app/render/picture.hpp"
#include "app/render/renderer.hpp"

namespace substep {

/// Parameters of a quality.
struct Grain {
  double scale = 1.0;      // of the window's width and height [-]
  int samples = 1;         // per pixel
  int shadow_size = 0;     // [texel]
  float taps = 1.0F;       // of the shadow map per pixel
  double tolerance = 0.5;  // of outlines [pixel]
  int vertices = 0;        // limit for bodies; beyond it outlines get coarser
  bool contacts = true;    // the ambient shadow is drawn
};
Grain grain_of(Quality quality);

/// The frame buffer to draw to, all of it.
struct Target {
  GLuint frame_buffer = 0;  // with a depth buffer
  int width = 0;            // [pixel]
  int height = 0;
};

/// Draws pictures in the OpenGL context that was current at construction.
class PicturePainter {
 public:
  /// Call first. @return false on error, with the reason appended to `error`
  bool build(std::string& error);
  ~PicturePainter();
  PicturePainter() = default;
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  /// Draws each picture in its part of the target.
  /// @param hidden parts of the target that are not shaded, from its top left corner
  void paint(std::span<const Picture> pictures, Quality quality, const Target& target,
             std::span<const PixelRect> hidden);

 private:
  // World to the light's clip space: a box around the focus, viewed along the light.
  [[nodiscard]] Eigen::Matrix4f light_matrix(const Picture& picture) const;
  void draw_picture(const Picture& picture, const Target& target,
                    std::span<const PixelRect> hidden);
  void draw_background(const Picture& picture);
  void draw_shadows(const Eigen::Matrix4f& light);
  // Uses a program that receives shadows, and sets its view and its shadow map.
  void use_in_light(const gl::Program& program, const Picture& picture,
                    const Eigen::Matrix4f& light) const;
  void draw_bodies(const Picture& picture, const Eigen::Matrix4f& light);
  void draw_ghosts(const Picture& picture, const Target& target);
  // Uploads the instances for draw_meshes().
  void upload(std::span<const Instance> boxes, std::span<const Instance> balls,
              const Picture& picture, const Target& target);
  void draw_meshes(const gl::Program& program) const;
  void draw_ground(const Picture& picture, const Eigen::Matrix4f& light);
  void draw_contacts(const Picture& picture);
  void draw_ribbons(const Picture& picture);

  gl::StreamBuffer ribbon_vertices_;
  gl::StreamBuffer contact_instances_;
  DetailedBodies bodies_;
  std::array<gl::BodyMesh, kBoxSegments.size()> boxes_{
      {{kBoxSegments[0], true}, {kBoxSegments[1], true}, {kBoxSegments[2], true}}};
  std::array<gl::BodyMesh, kBallSegments.size()> balls_{{{kBallSegments[0], false},
                                                         {kBallSegments[1], false},
                                                         {kBallSegments[2], false},
                                                         {kBallSegments[3], false},
                                                         {kBallSegments[4], false}}};
  gl::ShadowMap shadow_map_;
  std::array<gl::Program, 2> background_;  // smooth, rough
  std::array<gl::Program, 2> body_;
  std::array<gl::Program, 2> ground_;
  gl::Program shadow_;
  gl::Program contact_;
  gl::Program ribbon_;
  GLuint empty_array_ = 0;
  GLuint contact_array_ = 0;
  GLuint ribbon_array_ = 0;
  Grain grain_;            // of the current paint()
  std::size_t rough_ = 0;  // 1: with the shaders that glsl::kRough simplifies
};

}  // namespace substep
